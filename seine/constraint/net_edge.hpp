#pragma once

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// ∂/∂ of the two ends of a ring edge and of the point.
struct EdgeGradient {
  geom::Vec2 a, b, p;
};

/// How far p is on the inner (left) side of the line through the ring edge a → b, n·(p − a) with n = ê
/// turned left. The letter's topological safety asks it of every attachment and every ring edge it is no end
/// of [Pei24, Eq. 16]: the ring stays convex and counter-clockwise, so no car drives through the net. A
/// catch asks it of the target and every ring edge.
inline double net_edge(geom::Vec2 a, geom::Vec2 b, geom::Vec2 p, EdgeGradient& gradient) {
  const geom::Vec2 e = b - a, w = p - a;
  const double length = geom::norm(e);
  const double inside = geom::cross(e, w) / length;
  gradient.p = geom::left_normal(e) / length;
  gradient.b = geom::Vec2{w.y, -w.x} / length - (inside / (length * length)) * e;
  gradient.a = -gradient.b - gradient.p;
  return inside;
}

}  // namespace seine::constraint
