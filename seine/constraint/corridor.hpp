#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// n·(p + R(d) c) − b ≤ 0: footprint corner c (body frame) inside the half-plane n·x ≤ b, the car at p with
/// unit heading d.
/// @param g_position ∂/∂p, which is n  @param g_direction ∂/∂d
inline double corridor(geom::Vec2 p, geom::Vec2 d, geom::Vec2 corner, geom::Vec2 normal, double offset,
                       geom::Vec2& g_position, geom::Vec2& g_direction) {
  g_position = normal;
  g_direction = {corner.x * normal.x + corner.y * normal.y, corner.x * normal.y - corner.y * normal.x};
  return geom::dot(normal, p) + geom::dot(g_direction, d) - offset;
}

}  // namespace seine::constraint
