#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// |m − c| − radius ≤ 0: the middle of the net comes to rest in the region of delivery.
inline double delivery(geom::Vec2 middle, geom::Vec2 center, double radius, geom::Vec2& gradient) {
  const geom::Vec2 d = middle - center;
  const double distance = geom::norm(d);
  gradient = distance > 0.0 ? d / distance : geom::Vec2{};
  return distance - radius;
}

/// 1 − d·w ≤ 1 − cos(tolerance): a unit heading d along the wanted one w. Smooth, and zero in slope where
/// they agree.
inline double delivery_heading(geom::Vec2 direction, geom::Vec2 wanted, double most, geom::Vec2& gradient) {
  gradient = -wanted;
  return 1.0 - geom::dot(direction, wanted) - most;
}

}  // namespace seine::constraint
