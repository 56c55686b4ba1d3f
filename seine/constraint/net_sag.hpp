#pragma once

#include <cmath>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// The distance beyond which the empty net between two attachments sags no deeper than `depth`: the larger
/// root of ⅜ d (ℓ − d) = depth², ℓ the distance at rest; 0 when it never sags that deep.
inline double least_distance(double rest, double depth) {
  const double discriminant = 1.0 - depth * depth * 32.0 / (3.0 * rest * rest);
  return discriminant <= 0.0 ? 0.0 : 0.5 * rest * (1.0 + std::sqrt(discriminant));
}

/// least − |a − b| ≤ 0: the empty net does not drag.
inline double net_sag(geom::Vec2 a, geom::Vec2 b, double least, geom::Vec2& g_a, geom::Vec2& g_b) {
  const geom::Vec2 d = a - b;
  const double distance = geom::norm(d);
  g_b = d / distance;
  g_a = -g_b;
  return least - distance;
}

}  // namespace seine::constraint
