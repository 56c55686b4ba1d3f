#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// |a − b| − most ≤ 0: two attachments of a net are never further apart than the cloth between them reaches.
/// The letter bounds neighbours in the ring only [Pei24, Eq. 14]; here every pair, for the diagonals of the
/// cloth are as finite.
inline double net_stretch(geom::Vec2 a, geom::Vec2 b, double most, geom::Vec2& g_a, geom::Vec2& g_b) {
  const geom::Vec2 d = a - b;
  const double distance = geom::norm(d);
  g_a = d / distance;
  g_b = -g_a;
  return distance - most;
}

}  // namespace seine::constraint
