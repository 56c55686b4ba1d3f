// separation() against integer arithmetic: convex polygons on a lattice, whose distance, touch, or depth of
// overlap is known exactly, at all scales and far from the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/geom/convex.hpp"

namespace seine::geom {
namespace {

constexpr std::uint64_t kSeed = 83;

struct Point {
  std::int64_t x, y;
  friend bool operator==(Point, Point) = default;
};
using Polygon = std::vector<Point>;

std::int64_t cross_of(Point o, Point a, Point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Andrew's monotone chain; counter-clockwise, without points on its edges.
Polygon hull_of(Polygon p) {
  std::sort(p.begin(), p.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  p.erase(std::unique(p.begin(), p.end()), p.end());
  if (p.size() < 3) return p;
  Polygon hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = hull.size();
    for (const Point q : p) {
      while (hull.size() >= begin + 2 && cross_of(hull[hull.size() - 2], hull.back(), q) <= 0)
        hull.pop_back();
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

/// Of the origin from the segment ab: an integer numerator squared over an integer, rounded once.
long double to_segment(Point a, Point b) {
  const Point d{b.x - a.x, b.y - a.y};
  const std::int64_t along = -(a.x * d.x + a.y * d.y), length = d.x * d.x + d.y * d.y;
  if (along <= 0) return std::sqrt(static_cast<long double>(a.x * a.x + a.y * a.y));
  if (along >= length) return std::sqrt(static_cast<long double>(b.x * b.x + b.y * b.y));
  return static_cast<long double>(std::abs(a.x * b.y - a.y * b.x)) /
         std::sqrt(static_cast<long double>(length));
}

/// The signed distance: that of the origin from all differences b − a.
long double truth(const Polygon& a, const Polygon& b) {
  Polygon differences;
  for (const Point p : a)
    for (const Point q : b) differences.push_back({q.x - p.x, q.y - p.y});
  const Polygon hull = hull_of(differences);
  long double nearest = to_segment(hull.back(), hull.front());
  bool inside = hull.size() >= 3;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point p = hull[i], q = hull[(i + 1) % hull.size()];
    nearest = std::min(nearest, to_segment(p, q));
    inside = inside && cross_of({0, 0}, p, q) >= 0;
  }
  return inside ? -nearest : nearest;
}

Polygon random_polygon(Rng& rng, int size) {
  Polygon points;
  const int count = 1 + rng.below(8);
  const int wide = 1 + rng.below(size), tall = rng.below(4) == 0 ? 1 : 1 + rng.below(size);  // needles, too
  for (int i = 0; i < count; ++i)
    points.push_back({rng.below(2 * wide + 1) - wide, rng.below(2 * tall + 1) - tall});
  return hull_of(points);
}

TEST(ExactSeparation, AgreesWithIntegersAtAllScalesAndFarAway) {
  Rng rng(kSeed);
  const int pairs = effort(300000, 5000);
  int overlapping = 0, touching = 0;
  long double worst = 0.0L;
  for (int i = 0; i < pairs; ++i) {
    // Coarse lattices have many ties, parallel edges and touches.
    const int size = std::array{3, 20, 1000, 1 << 20}[static_cast<std::size_t>(rng.below(4))];
    const Polygon a = random_polygon(rng, size);
    Polygon b = random_polygon(rng, size);
    const int shift = rng.below(3) * size;
    const Point off{rng.below(shift + 1) - shift / 2, rng.below(shift + 1) - shift / 2};
    for (Point& p : b) p.x += off.x, p.y += off.y;
    const long double exact = truth(a, b);
    overlapping += exact < 0.0L, touching += exact == 0.0L;
    // Powers of two and whole offsets keep every coordinate exact.
    const double scale = std::ldexp(1.0, rng.below(50) - 30);
    const bool far = rng.below(2) == 0 && size <= 1000;
    const double away = far ? scale * static_cast<double>(rng.below(1 << 30)) : 0.0;
    const auto real = [&](const Polygon& polygon) {
      std::vector<Vec2> result;
      for (const Point p : polygon)
        result.push_back({scale * static_cast<double>(p.x) + away, scale * static_cast<double>(p.y) - away});
      return result;
    };
    const std::vector<Vec2> ra = real(a), rb = real(b);
    const long double wanted = exact * static_cast<long double>(scale);
    // Vertices nearer than 1e-11 m are one to it; far away, coordinates are multiplied before they are
    // subtracted.
    const double tolerance = 2e-11 + 1e-12 * scale * (size + shift) + 1e-15 * away;
    const double found = separation(std::span<const Vec2>(ra), std::span<const Vec2>(rb)).distance;
    worst = std::max(worst, std::abs(found - wanted) / static_cast<long double>(scale * (size + shift)));
    ASSERT_NEAR(found, static_cast<double>(wanted), tolerance) << "seed " << kSeed << ", pair " << i;
    ASSERT_NEAR(distance(ra, rb), static_cast<double>(wanted), tolerance)
        << "seed " << kSeed << ", pair " << i;
  }
  EXPECT_GT(overlapping, pairs / 10);
  EXPECT_GT(touching, pairs / 100);
  RecordProperty("worst_relative_error", std::to_string(static_cast<double>(worst)));
}

}  // namespace
}  // namespace seine::geom
