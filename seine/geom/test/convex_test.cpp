#include "seine/geom/convex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/polygon.hpp"

namespace seine::geom {
namespace {

constexpr std::uint64_t kSeed = 20240917;

std::vector<Vec2> random_core(Rng& rng, Vec2 center, double size) {
  const int count = 1 + rng.below(8);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(center + rng.uniform(0.1, size) * unit(rng.uniform(0.0, 2.0 * std::numbers::pi)));
  }
  return convex_hull(points);
}

double point_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double t = squared_norm(d) > 0.0 ? std::clamp(dot(p - a, d) / squared_norm(d), 0.0, 1.0) : 0.0;
  return norm(p - a - t * d);
}

// Independent of the code under test: the Minkowski difference as the hull of all vertex differences, and the
// origin against it.
double brute_force(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  std::vector<Vec2> differences;
  for (const Vec2 p : a) {
    for (const Vec2 q : b) differences.push_back(q - p);
  }
  const std::vector<Vec2> hull = convex_hull(differences);
  double boundary = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    boundary = std::min(boundary, point_segment({0.0, 0.0}, hull[i], hull[(i + 1) % hull.size()]));
  }
  return hull.size() >= 3 && contains(hull, {0.0, 0.0}) ? -boundary : boundary;
}

void expect_witnesses(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const Separation& s) {
  EXPECT_NEAR(norm(s.normal), 1.0, 1e-9);
  EXPECT_NEAR(dot(s.point_b - s.point_a, s.normal), s.distance, 1e-9);
  EXPECT_NEAR(norm(s.point_b - s.point_a), std::abs(s.distance), 1e-9);
  EXPECT_NEAR(brute_force(a, {s.point_a}), 0.0, 1e-9);
  EXPECT_NEAR(brute_force(b, {s.point_b}), 0.0, 1e-9);
  // The normal is the direction that parts them: so moved, b is as far as the distance and the step say.
  std::vector<Vec2> moved = b;
  const double step = s.distance < 0.0 ? 0.1 - s.distance : 0.1;
  for (Vec2& p : moved) p += step * s.normal;
  EXPECT_NEAR(brute_force(a, moved), s.distance + step, 1e-8);
}

TEST(Convex, SeparationIsTheDistanceOfTheOriginFromTheMinkowskiDifference) {
  Rng rng(kSeed);
  for (int i = 0; i < 40000; ++i) {
    const std::vector<Vec2> a = random_core(rng, {0.0, 0.0}, 1.0);
    const std::vector<Vec2> b = random_core(rng, rng.uniform(0.0, 3.0) * unit(rng.uniform(0.0, 6.3)), 1.0);
    const double expected = brute_force(a, b);
    const Separation s = separation(a, b);
    ASSERT_NEAR(s.distance, expected, 1e-9) << "seed " << kSeed << " case " << i;
    ASSERT_NEAR(distance(a, b), expected, 1e-9) << "seed " << kSeed << " case " << i;
    ASSERT_NEAR(distance(b, a), expected, 1e-9) << "seed " << kSeed << " case " << i;
    expect_witnesses(a, b, s);
    if (HasFailure()) FAIL() << "seed " << kSeed << " case " << i;
  }
}

TEST(Convex, SeparationOnALatticeOfTiesAndDegeneracies) {
  // Integer coordinates make parallel edges, collinear and touching shapes and coincident vertices the rule.
  Rng rng(kSeed);
  for (int i = 0; i < 60000; ++i) {
    const auto lattice = [&rng] {
      std::vector<Vec2> points(static_cast<std::size_t>(1 + rng.below(4)));
      for (Vec2& p : points) p = {static_cast<double>(rng.below(4)), static_cast<double>(rng.below(4))};
      return convex_hull(points);
    };
    const std::vector<Vec2> a = lattice();
    const std::vector<Vec2> b = lattice();
    const double expected = brute_force(a, b);
    const Separation s = separation(a, b);
    ASSERT_NEAR(s.distance, expected, 1e-9) << "seed " << kSeed << " case " << i;
    ASSERT_NEAR(distance(a, b), expected, 1e-9) << "seed " << kSeed << " case " << i;
    if (expected > 0.0 || (a.size() > 2 && b.size() > 2)) expect_witnesses(a, b, s);
    if (HasFailure()) FAIL() << "seed " << kSeed << " case " << i;
  }
}

TEST(Convex, RadiiAreTakenOff) {
  const Convex disc{{{0.0, 0.0}}, 0.5};
  const Convex square{{{2.0, -1.0}, {4.0, -1.0}, {4.0, 1.0}, {2.0, 1.0}}, 0.25};
  const Separation s = separation(disc, square);
  EXPECT_DOUBLE_EQ(s.distance, 1.25);
  EXPECT_DOUBLE_EQ(s.point_a.x, 0.5);
  EXPECT_DOUBLE_EQ(s.point_b.x, 1.75);
  EXPECT_DOUBLE_EQ(separation(square, disc).normal.x, -1.0);
}

TEST(Convex, HullIsConvexAndHoldsEveryPoint) {
  Rng rng(kSeed);
  for (int i = 0; i < 500; ++i) {
    std::vector<Vec2> points(static_cast<std::size_t>(3 + rng.below(30)));
    for (Vec2& p : points) p = {std::floor(rng.uniform(0.0, 8.0)), std::floor(rng.uniform(0.0, 8.0))};
    const std::vector<Vec2> hull = convex_hull(points);
    if (hull.size() < 3) continue;
    EXPECT_TRUE(is_convex(hull));
    for (const Vec2 p : points) EXPECT_TRUE(contains(hull, p)) << "seed " << kSeed << " case " << i;
  }
}

TEST(Convex, PlacedTurnsAndShifts) {
  const Convex body{{{1.0, 0.0}, {0.0, 2.0}, {0.0, 0.0}}, 0.1};
  const Convex world = placed(body, {5.0, 6.0, 0.5 * std::numbers::pi});
  EXPECT_NEAR(world.core[0].x, 5.0, 1e-15);
  EXPECT_NEAR(world.core[0].y, 7.0, 1e-15);
  EXPECT_NEAR(world.core[1].x, 3.0, 1e-15);
  EXPECT_EQ(world.radius, 0.1);
}

}  // namespace
}  // namespace seine::geom
