#include "seine/net/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/net/hanging.hpp"
#include "seine/net/test/nets.hpp"

namespace seine::net {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 41;

TEST(Opening, OfAScaledCopyIsItsScale) {
  Rng rng(kSeed);
  for (std::size_t corners = 3; corners <= 8; ++corners) {
    const Net net = net_of(random_convex(rng, corners));
    const double scale = rng.uniform(0.3, 1.2);
    const Vec2 turn = geom::unit(rng.uniform(-3.0, 3.0));
    std::vector<Vec2> hold;
    for (const Vec2 r : net.rest)
      hold.push_back(scale * Vec2{turn.x * r.x - turn.y * r.y, turn.y * r.x + turn.x * r.y});
    EXPECT_NEAR(opening(net, hold), scale, 1e-12) << "seed " << kSeed;
    std::reverse(hold.begin(), hold.end());
    EXPECT_EQ(opening(net, hold), 0.0);
    EXPECT_NEAR(rest_distance(net, 0, 2), geom::norm(net.rest[0] - net.rest[2]), 0.0);
  }
}

// The length of y = a cosh(x / a) over [−d/2, d/2], piece by piece, for the a that gives this sag (bisected).
double catenary_length(double distance, double sag) {
  double low = 1e-6, high = 1e9;
  for (int i = 0; i < 400; ++i) {
    const double a = std::sqrt(low * high), x = 0.5 * distance / a;
    (x > 700.0 || 2.0 * a * std::pow(std::sinh(0.5 * x), 2.0) > sag ? low : high) = a;
  }
  constexpr int kSteps = 20000;
  const auto height = [&](int i) {
    const double x = distance * (static_cast<double>(i) / kSteps - 0.5);
    return 2.0 * low * std::pow(std::sinh(0.5 * x / low), 2.0);
  };
  double length = 0.0;
  for (int i = 0; i < kSteps; ++i) length += std::hypot(distance / kSteps, height(i + 1) - height(i));
  return length;
}

TEST(Sag, IsThatOfACatenary) {
  for (const double rest : {0.01, 2.0, 300.0})
    for (const double ratio : {0.02, 0.1, 0.15, 0.3, 0.5, 0.80, 0.86, 0.90, 0.95, 0.99, 0.999})
      EXPECT_NEAR(catenary_length(ratio * rest, sag(ratio * rest, rest)), rest, 2e-5 * rest) << ratio;
  // Textbook: a rope twice as long as its span hangs 0.796 spans deep.
  EXPECT_NEAR(sag(1.0, 2.0), 0.796, 1e-3);
  EXPECT_EQ(sag(2.0, 2.0), 0.0);
  EXPECT_EQ(sag(2.1, 2.0), 0.0);
  EXPECT_EQ(sag(0.0, 2.0), 1.0);
  double before = 1.0;
  for (double d = 1e-9; d < 2.0; d = 1.1 * d + 1e-9) {  // deeper the nearer
    EXPECT_LE(sag(d, 2.0), before);
    EXPECT_LT(sag(d, 2.0), std::sqrt(1.0 - 0.25 * d * d)) << "deeper than a load";
    before = sag(d, 2.0);
  }
}

TEST(Inradius, NoPointIsFurtherInsideAndOneIsAsFar) {
  Rng rng(kSeed);
  EXPECT_NEAR(inradius(regular_polygon(4, 1.0)), std::sqrt(0.5), 1e-12);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Vec2> polygon = random_convex(rng, 3 + static_cast<std::size_t>(rng.below(6)));
    const double found = inradius(polygon);
    double best = -1.0;
    Vec2 at;
    for (int i = 0; i < 3000; ++i) {  // a search that narrows down
      const double reach = std::pow(0.997, i);
      const Vec2 p = at + Vec2{rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
      if (const double inside = margin_inside(polygon, p); inside > best) best = inside, at = p;
    }
    EXPECT_LE(best, found + 1e-9);
    EXPECT_GT(best, found - 1e-2);
  }
}

TEST(EmptyDepth, IsTheDeepestPair) {
  Rng rng(kSeed);
  for (int round = 0; round < 500; ++round) {
    const std::size_t corners = 3 + static_cast<std::size_t>(rng.below(6));
    const Net net = net_of(random_convex(rng, corners));
    const std::vector<Vec2> hold = random_hold(rng, net.rest);
    double deepest = 0.0;
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double d = geom::norm(hold[i] - hold[j]);
        deepest = std::max(deepest, sag(d, geom::norm(net.rest[i] - net.rest[j])));
      }
    EXPECT_NEAR(empty_depth(net, hold), deepest, 1e-12) << "round " << round << ", seed " << kSeed;
  }
}

TEST(EmptyDepth, IsLessThanThatOfALoadInRegularNets) {
  for (std::size_t corners = 3; corners <= 8; ++corners) {
    const Net net = net_of(regular_polygon(corners, 1.3));
    for (double scale = 0.02; scale < 1.0; scale += 0.01) {
      const std::vector<Vec2> hold = regular_polygon(corners, 1.3 * scale);
      EXPECT_LT(empty_depth(net, hold), loaded_depth(net, hold));
    }
  }
}

TEST(MarginInside, IsTheDistanceToTheNearestPointOfTheBorder) {
  Rng rng(kSeed);
  for (int round = 0; round < 200; ++round) {
    const std::vector<Vec2> polygon = random_convex(rng, 3 + static_cast<std::size_t>(rng.below(6)));
    const Vec2 p{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)};
    double nearest = 1e9;
    bool inside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      inside = inside && geom::cross(b - a, p - a) > 0.0;
      for (int s = 0; s <= 2000; ++s) nearest = std::min(nearest, geom::norm(p - a - (s / 2000.0) * (b - a)));
    }
    const double margin = margin_inside(polygon, p);
    EXPECT_EQ(margin > 0.0, inside);
    EXPECT_NEAR(std::abs(margin), nearest, 1e-3) << "round " << round << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace seine::net
