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

double parabola_length(double distance, double depth) {
  double length = 0.0;
  constexpr int kSteps = 4000;
  const auto height = [&](int i) {
    const double x = static_cast<double>(i) / kSteps;
    return 4.0 * depth * x * (1.0 - x);
  };
  for (int i = 0; i < kSteps; ++i) length += std::hypot(distance / kSteps, height(i + 1) - height(i));
  return length;
}

TEST(Sag, IsTheParabolaOfThatLengthToLeadingOrder) {
  for (const double ratio : {0.80, 0.86, 0.90, 0.95, 0.99, 0.999}) {
    const double rest = 2.0;
    const double depth = sag(ratio * rest, rest);
    // The next term of the parabola's length is −32/5 (s/d)⁴ d.
    const double e = depth / (ratio * rest);
    const double length = parabola_length(ratio * rest, depth);
    EXPECT_LE(length, rest);
    EXPECT_NEAR(length, rest - 6.4 * e * e * e * e * ratio * rest, 80.0 * std::pow(e, 6.0));
  }
  EXPECT_EQ(sag(2.0, 2.0), 0.0);
  EXPECT_EQ(sag(2.1, 2.0), 0.0);
  EXPECT_EQ(sag(0.0, 2.0), 0.0);
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
        deepest = std::max(deepest, std::sqrt(0.375 * d * (geom::norm(net.rest[i] - net.rest[j]) - d)));
      }
    EXPECT_NEAR(empty_depth(net, hold), deepest, 1e-12) << "round " << round << ", seed " << kSeed;
  }
}

TEST(EmptyDepth, IsLessThanThatOfALoadInRegularNets) {
  for (std::size_t corners = 3; corners <= 8; ++corners) {
    const Net net = net_of(regular_polygon(corners, 1.3));
    for (double scale = 0.7; scale < 1.0; scale += 0.01) {
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
