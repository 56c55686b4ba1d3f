#pragma once

#include <array>

#include "seine/geom/vec3.hpp"

namespace seine::net {

/// An object to catch. Free flight begins at `time` in this state; until then it is not in the air.
struct Target {
  double time = 0.0;  ///< s, common clock
  geom::Vec3 position, velocity;
  double radius = 0.08;                               ///< m
  double mass = 0.25;                                 ///< kg
  double drag = 0.0;                                  ///< 1/m: a = g − drag |v| v
  std::array<std::array<double, 6>, 6> covariance{};  ///< of (position, velocity) at `time`; zero: exact
};

}  // namespace seine::net
