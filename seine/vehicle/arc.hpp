#pragma once

#include <cmath>

#include "seine/geom/pose2.hpp"

namespace seine::vehicle {

/// Where a car at `from` stands after `distance` metres (negative: backwards) with the front wheel held at
/// `curvature` (1/m). Exact: a circular arc; a straight line for |curvature · distance| → 0.
inline geom::Pose2 drive(const geom::Pose2& from, double curvature, double distance) {
  const double half_turn = 0.5 * curvature * distance;
  // sin(h)/h by its series where the quotient loses digits: the next term is below 1e-17 there.
  const double h2 = half_turn * half_turn;
  const double sinc =
      std::abs(half_turn) < 1e-3 ? 1.0 - h2 / 6.0 * (1.0 - h2 / 20.0) : std::sin(half_turn) / half_turn;
  const double chord = distance * sinc;
  const geom::Vec2 along = geom::unit(from.heading + half_turn);
  return {from.x + chord * along.x, from.y + chord * along.y,
          geom::wrap_angle(from.heading + 2.0 * half_turn)};
}

/// A stretch with the front wheel held still.
struct Arc {
  double curvature = 0.0;  ///< 1/m, positive: wheel to the left
  double distance = 0.0;   ///< m, signed: negative backwards

  int gear() const { return distance < 0.0 ? -1 : 1; }
};

inline geom::Pose2 drive(const geom::Pose2& from, const Arc& arc) {
  return drive(from, arc.curvature, arc.distance);
}

}  // namespace seine::vehicle
