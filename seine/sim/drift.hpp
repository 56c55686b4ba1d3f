#pragma once

#include <span>

#include "seine/geom/vec3.hpp"

namespace seine::sim {

/// How the corners of a net move, taken as a rigid body in the plane: what the air in the net and the net
/// itself take for standing still.
struct Drift {
  geom::Vec3 middle, velocity;  ///< m, m/s
  double yaw_rate = 0.0;        ///< rad/s

  /// Velocity of the place `p`, m/s.
  geom::Vec3 at(geom::Vec3 p) const {
    return {velocity.x - yaw_rate * (p.y - middle.y), velocity.y + yaw_rate * (p.x - middle.x), velocity.z};
  }
};

/// Of corners that went from `before` to `now` in `duration` (s): the best fit in least squares.
Drift drift(std::span<const geom::Vec3> before, std::span<const geom::Vec3> now, double duration);

}  // namespace seine::sim
