#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// reserve − 2 ((r_i − r_k)·(r_j − r_k) − (a_i − a_k)·(a_j − a_k)) ≤ 0 for a ring edge (i, j) and another
/// corner k: what lies in the net comes to rest inside it and does not roll out over that edge
/// (net::holding_reserve).
/// @param rest (r_i − r_k)·(r_j − r_k)
inline double net_hold(geom::Vec2 i, geom::Vec2 j, geom::Vec2 k, double rest, double reserve, geom::Vec2& g_i,
                       geom::Vec2& g_j, geom::Vec2& g_k) {
  const geom::Vec2 u = i - k, v = j - k;
  g_i = 2.0 * v, g_j = 2.0 * u;
  g_k = -(g_i + g_j);
  return reserve - 2.0 * (rest - geom::dot(u, v));
}

}  // namespace seine::constraint
