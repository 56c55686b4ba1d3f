#pragma once

#include <cmath>
#include <numbers>

#include "seine/geom/vec2.hpp"

namespace seine::geom {

/// `angle` wrapped into (−π, π].
inline double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2.0 * std::numbers::pi : wrapped;
}

/// A body frame in the world: x forward, y left, heading from the world's x axis (REP-103).
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;

  Vec2 position() const { return {x, y}; }
  Vec2 direction() const { return unit(heading); }
  /// A body-frame point in the world.
  Vec2 operator*(Vec2 body) const {
    const Vec2 d = direction();
    return {x + d.x * body.x - d.y * body.y, y + d.y * body.x + d.x * body.y};
  }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

}  // namespace seine::geom
