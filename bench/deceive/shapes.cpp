#include "bench/deceive/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seine::deceive {
namespace {

using geom::Vec2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double share =
      squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

double side(Vec2 a, Vec2 b, Vec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

template <class Visit>
void each_edge(std::span<const Vec2> polygon, Visit&& visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

/// The least distance of two rims that do not cross.
double between_rims(std::span<const Vec2> a, std::span<const Vec2> b) {
  double least = kInfinity;
  for (const Vec2 p : a) least = std::min(least, distance_to_rim(p, b));
  for (const Vec2 p : b) least = std::min(least, distance_to_rim(p, a));
  return least;
}

/// The widest gap along the normals of a's edges; negative: an overlap along all of them.
double widest_gap(std::span<const Vec2> a, std::span<const Vec2> b) {
  double widest = -kInfinity;
  each_edge(a, [&](Vec2 p, Vec2 q) {
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    if (length == 0.0) return;
    const double nx = (q.y - p.y) / length, ny = -(q.x - p.x) / length;
    double most = -kInfinity, least = kInfinity;
    for (const Vec2 v : a) most = std::max(most, nx * (v.x - p.x) + ny * (v.y - p.y));
    for (const Vec2 v : b) least = std::min(least, nx * (v.x - p.x) + ny * (v.y - p.y));
    widest = std::max(widest, least - most);
  });
  return widest;
}

}  // namespace

Polygon placed(std::span<const Vec2> body, const geom::Pose2& pose) {
  const double c = std::cos(pose.heading), s = std::sin(pose.heading);
  Polygon polygon;
  polygon.reserve(body.size());
  for (const Vec2 p : body) polygon.push_back({pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y});
  return polygon;
}

double distance_to_rim(Vec2 point, std::span<const Vec2> polygon) {
  double least = kInfinity;
  each_edge(polygon, [&](Vec2 a, Vec2 b) { least = std::min(least, to_segment(point, a, b)); });
  return least;
}

bool inside(Vec2 point, std::span<const Vec2> polygon) {
  bool odd = false;
  each_edge(polygon, [&](Vec2 a, Vec2 b) {
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
      odd = !odd;
  });
  return odd;
}

double convex_distance(std::span<const Vec2> a, std::span<const Vec2> b) {
  const double gap = std::max(widest_gap(a, b), widest_gap(b, a));
  return gap > 0.0 ? between_rims(a, b) : gap;
}

double polygon_distance(std::span<const Vec2> a, std::span<const Vec2> b) {
  double depth = -1.0;
  for (const Vec2 p : a)
    if (inside(p, b)) depth = std::max(depth, distance_to_rim(p, b));
  for (const Vec2 p : b)
    if (inside(p, a)) depth = std::max(depth, distance_to_rim(p, a));
  if (depth >= 0.0) return -depth;
  bool crossed = false;
  each_edge(a, [&](Vec2 p, Vec2 q) {
    each_edge(b, [&](Vec2 r, Vec2 s) { crossed = crossed || cross_each_other(p, q, r, s); });
  });
  return crossed ? 0.0 : between_rims(a, b);
}

double disc_distance(std::span<const Vec2> polygon, Vec2 center, double radius) {
  const double rim = distance_to_rim(center, polygon);
  return (inside(center, polygon) ? -rim : rim) - radius;
}

}  // namespace seine::deceive
