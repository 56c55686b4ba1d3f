#include "seine/baseline/letter/catch_cost.hpp"

#include <algorithm>
#include <cmath>

namespace seine::baseline::letter {

using geom::Vec2;

double clamped(double x, double epsilon, double& slope) {
  const double e = epsilon, e2 = e * e;
  slope = 0.0;
  if (x <= 0.0) return 0.0;
  if (x > 1.0) return 1.0;
  if (x <= e) {
    slope = (-3.0 * x / e2 + 4.0 / e) * x;
    return (-x / e2 + 2.0 / e) * x * x;
  }
  if (x <= 1.0 - e) {
    slope = 1.0;
    return x;
  }
  const double y = 1.0 - x;  // the same from the other end
  slope = (-3.0 * y / e2 + 4.0 / e) * y;
  return 1.0 - (-y / e2 + 2.0 / e) * y * y;
}

EdgeDistance edge_distance(Vec2 a, Vec2 b, Vec2 p, double epsilon) {
  const Vec2 e = b - a, w = p - a;
  const double squared = geom::squared_norm(e), s = geom::dot(w, e) / squared;
  double slope;
  const double at = clamped(s, epsilon, slope);
  const Vec2 r = w - at * e;
  const double sign = geom::cross(e, w) > 0.0 ? -1.0 : 1.0;
  const double distance = geom::norm(r);
  // On the edge itself the distance is that to the line.
  const Vec2 away = distance > 1e-12 ? (sign / distance) * r : -geom::left_normal(e) / std::sqrt(squared);
  // r = p − a − L(s)(b − a), with ∂s/∂b = (w − 2 s e)/|e|² and ∂s/∂a = −∂s/∂b − e/|e|².
  const double pull = -slope * geom::dot(away, e);
  const Vec2 s_b = (w - (2.0 * s) * e) / squared;
  EdgeDistance result;
  result.value = sign * distance;
  result.g_b = -at * away + pull * s_b;
  result.g_a = -(1.0 - at) * away - pull * (s_b + e / squared);
  return result;
}

double catch_cost(double distance, const CatchWeights& weights, double& slope) {
  const double inner = weights.centring, outer = weights.catching, e = weights.blend, D = distance;
  if (D < -e || D > e) {
    slope = D > 0.0 ? outer : inner;
    return slope * D;
  }
  const double quartic = (inner - outer) / (4.0 * e * e * e), square = -3.0 * (inner - outer) / (4.0 * e);
  const double linear = 0.5 * (inner + outer);
  slope = (4.0 * quartic * D * D + 2.0 * square) * D + linear;
  return ((quartic * D * D + square) * D + linear) * D;
}

double net_distance(std::span<const Vec2> ring, Vec2 p, double epsilon, std::span<Vec2> g_ring) {
  std::ranges::fill(g_ring, Vec2{});
  EdgeDistance nearest;
  std::size_t edge = ring.size();
  bool inside = true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const EdgeDistance d = edge_distance(ring[i], ring[(i + 1) % ring.size()], p, epsilon);
    inside = inside && d.value <= 0.0;
    if (edge < ring.size() && std::abs(d.value) >= std::abs(nearest.value)) continue;
    nearest = d;
    edge = i;
  }
  // Beyond a corner the nearest edge may have p on its inner side, though p is outside.
  const double sign = inside == (nearest.value <= 0.0) ? 1.0 : -1.0;
  g_ring[edge] = sign * nearest.g_a;
  g_ring[(edge + 1) % ring.size()] = sign * nearest.g_b;
  return sign * nearest.value;
}

}  // namespace seine::baseline::letter
