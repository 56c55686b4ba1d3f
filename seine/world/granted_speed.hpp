#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "seine/vehicle/model.hpp"

namespace seine::world {

/// How far a measured start speed may be over the limit: a share of the limit …
inline constexpr double kOverspeed = 0.01;
/// … or so many m/s, whichever is more: a car without reverse gear is measured to roll back by a millimetre.
inline constexpr double kOverspeedFloor = 1e-3;

/// The start speed (m/s, signed) that a plan begins with: the measured one, or the limit where it is no more
/// than the tolerance beyond; nothing where it is further beyond, or no number.
inline std::optional<double> granted_speed(const vehicle::Limits& limits, double measured) {
  const double limit = measured < 0.0 ? limits.reverse_speed : limits.speed;
  if (std::abs(measured) <= limit) return measured;
  if (std::abs(measured) <= std::max((1.0 + kOverspeed) * limit, limit + kOverspeedFloor))
    return std::copysign(limit, measured);
  return std::nullopt;
}

}  // namespace seine::world
