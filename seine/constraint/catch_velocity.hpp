#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// |v − (q − p) / span| − most ≤ 0: how fast an object flies sideways over a net whose middle goes from p to
/// q within `span`: its angle and its speed relative to the formation.
inline double catch_velocity(geom::Vec2 p, geom::Vec2 q, double span, geom::Vec2 velocity, double most,
                             geom::Vec2& g_p, geom::Vec2& g_q) {
  const geom::Vec2 relative = velocity - (q - p) / span;
  const double speed = geom::norm(relative);
  g_p = speed > 0.0 ? relative / (speed * span) : geom::Vec2{};
  g_q = -g_p;
  return speed - most;
}

}  // namespace seine::constraint
