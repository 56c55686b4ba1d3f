#include "seine/constraint/net_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/geom/convex.hpp"

namespace seine::constraint {

double net_clearance(std::span<const geom::Vec2> polygon, std::span<const geom::Vec2> obstacle,
                     std::span<geom::Vec2> gradient) {
  const geom::Separation s = geom::separation(polygon, obstacle);
  // The witness on the polygon lies on an edge and rides with its ends (envelope theorem).
  std::size_t edge = 0;
  double nearest = std::numeric_limits<double>::infinity(), share = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const geom::Vec2 a = polygon[k], e = polygon[(k + 1) % polygon.size()] - a;
    const double t = std::clamp(geom::dot(s.point_a - a, e) / geom::squared_norm(e), 0.0, 1.0);
    const double off = geom::squared_norm(s.point_a - (a + t * e));
    if (off < nearest) nearest = off, edge = k, share = t;
  }
  std::fill(gradient.begin(), gradient.end(), geom::Vec2{});
  gradient[edge] = -(1.0 - share) * s.normal;
  gradient[(edge + 1) % polygon.size()] -= share * s.normal;
  return s.distance;
}

}  // namespace seine::constraint
