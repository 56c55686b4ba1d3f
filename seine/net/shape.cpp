#include "seine/net/shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "seine/geom/polygon.hpp"

namespace seine::net {

using geom::Vec2;

double rest_distance(const Net& net, std::size_t i, std::size_t j) {
  return geom::norm(net.rest[i] - net.rest[j]);
}

double opening(const Net& net, std::span<const Vec2> attachments) {
  assert(attachments.size() == net.size());
  const double area = geom::signed_area(attachments);
  return area > 0.0 ? std::sqrt(area / geom::signed_area(net.rest)) : 0.0;
}

// The largest circle touches three edges (or as good a one does): the best of all that stay inside.
double inradius(std::span<const Vec2> polygon) {
  struct Line {
    Vec2 inward;
    double offset;  // distance inside = inward · p − offset
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[i + 1 == polygon.size() ? 0 : i + 1] - polygon[i];
    const Vec2 inward = geom::left_normal(edge) / geom::norm(edge);
    lines.push_back({inward, geom::dot(inward, polygon[i])});
  }
  double best = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j)
      for (std::size_t k = j + 1; k < lines.size(); ++k) {
        // n_i · p − o_i is the same for all three.
        const Vec2 a = lines[i].inward - lines[k].inward, b = lines[j].inward - lines[k].inward;
        const double u = lines[i].offset - lines[k].offset, v = lines[j].offset - lines[k].offset;
        const double determinant = geom::cross(a, b);
        if (std::abs(determinant) < 1e-12) continue;
        const Vec2 p{(u * b.y - v * a.y) / determinant, (a.x * v - b.x * u) / determinant};
        best = std::max(best, margin_inside(polygon, p));
      }
  return best;
}

// With x = d / 2a, a the catenary's parameter: ℓ/d = sinh x / x and the sag is a (cosh x − 1) = ½ ℓ tanh ½ x.
double sag(double distance, double rest) {
  if (distance >= rest) return 0.0;
  if (!(distance > 1e-12 * rest)) return 0.5 * rest;
  const double wanted = std::log(rest / distance);
  // log(sinh x / x) grows like x²/6 first and like x − log 2x later; Newton's steps from above or below
  // settle within a few rounds.
  double x = wanted < 1.0 ? std::sqrt(6.0 * wanted) : wanted + std::log(2.0 * wanted + 2.0);
  for (int round = 0; round < 30; ++round) {
    const double growth = 1.0 / std::tanh(x) - 1.0 / x;
    const double off = x + std::log(-std::expm1(-2.0 * x) / (2.0 * x)) - wanted;
    const double step = growth > 1e-9 ? off / growth : 0.0;
    x = std::max(x - step, 0.1 * x);
    if (std::abs(step) < 1e-14 * x) break;
  }
  return 0.5 * rest * std::tanh(0.5 * x);
}

double empty_depth(const Net& net, std::span<const Vec2> attachments) {
  assert(attachments.size() == net.size());
  double deepest = 0.0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    for (std::size_t j = i + 1; j < net.size(); ++j) {
      const double apart = geom::norm(attachments[i] - attachments[j]);
      deepest = std::max(deepest, sag(apart, rest_distance(net, i, j)));
    }
  }
  return deepest;
}

double margin_inside(std::span<const Vec2> polygon, Vec2 p) {
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 tail = polygon[i];
    const Vec2 edge = polygon[i + 1 == polygon.size() ? 0 : i + 1] - tail;
    const Vec2 to = p - tail;
    inside = inside && geom::cross(edge, to) >= 0.0;
    const double length = geom::squared_norm(edge);
    const double along = length > 0.0 ? std::clamp(geom::dot(to, edge) / length, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, geom::norm(to - along * edge));
  }
  return inside ? nearest : -nearest;
}

}  // namespace seine::net
