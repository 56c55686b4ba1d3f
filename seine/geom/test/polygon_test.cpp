#include "seine/geom/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/geom/box.hpp"

namespace seine::geom {
namespace {

constexpr std::uint64_t kSeed = 99;

// Star-shaped about the origin: simple, mostly non-convex, either orientation.
std::vector<Vec2> random_star(Rng& rng, int count) {
  std::vector<double> angles(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    angles[i] = 2.0 * std::numbers::pi * (static_cast<double>(i) + rng.uniform(0.0, 0.9)) / count;
  }
  std::vector<Vec2> polygon;
  for (const double angle : angles) polygon.push_back(rng.uniform(0.3, 3.0) * unit(angle));
  if (rng.below(2) == 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

// A comb of unit cells: right angles, straight vertices, long thin necks.
std::vector<Vec2> comb(int teeth) {
  std::vector<Vec2> polygon{{0.0, 0.0}};
  for (int i = 0; i <= 2 * teeth; ++i) polygon.push_back({static_cast<double>(i + 1), 0.0});
  for (int i = 2 * teeth; i >= 0; --i) {
    const double top = i % 2 == 0 ? 4.0 : 1.0;
    polygon.push_back({static_cast<double>(i + 1), top});
    polygon.push_back({static_cast<double>(i), top});
  }
  return polygon;
}

void expect_exact_cover(const std::vector<Vec2>& polygon, Rng& rng) {
  const std::vector<std::vector<Vec2>> parts = convex_parts(polygon);
  double area = 0.0;
  for (const auto& part : parts) {
    EXPECT_TRUE(is_convex(part));
    area += signed_area(part);
  }
  EXPECT_NEAR(area, std::abs(signed_area(polygon)), 1e-9);
  const Box box = bounding_box(polygon);
  for (int i = 0; i < 200; ++i) {
    const Vec2 p{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
    const bool covered =
        std::any_of(parts.begin(), parts.end(), [p](const auto& part) { return contains(part, p); });
    EXPECT_EQ(covered, contains(polygon, p)) << p.x << ", " << p.y;
  }
}

TEST(Polygon, ConvexPartsCoverItExactly) {
  Rng rng(kSeed);
  for (int i = 0; i < 500; ++i) {
    const std::vector<Vec2> polygon = random_star(rng, 3 + rng.below(30));
    if (!why_not_simple(polygon).empty()) continue;
    expect_exact_cover(polygon, rng);
    if (HasFailure()) FAIL() << "seed " << kSeed << " case " << i;
  }
  for (int teeth = 1; teeth < 8; ++teeth) expect_exact_cover(comb(teeth), rng);
}

TEST(Polygon, PartsAreFewEnough) {
  // Merging leaves at most four times the least number [Hertel83]; a convex polygon stays whole, an L is two.
  EXPECT_EQ(convex_parts(std::vector<Vec2>{{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}).size(), 1U);
  EXPECT_EQ(convex_parts(std::vector<Vec2>{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}).size(), 2U);
}

TEST(Polygon, SaysWhyItIsNotSimple) {
  EXPECT_EQ(why_not_simple(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}), "");
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {1, 0}}).find("at least 3"), std::string::npos);
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0}, {0, 1}}).find("2 and 3"),
            std::string::npos);
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {2, 2}, {2, 0}, {0, 2}}).find("cross"),
            std::string::npos);
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}}), "");           // flat
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {3, 0}, {3, 1}, {3, -1}}), "");  // spike
  EXPECT_NE(why_not_simple(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}),
            "");  // touches an edge
  EXPECT_THROW(convex_parts(std::vector<Vec2>{{0, 0}, {2, 2}, {2, 0}, {0, 2}}), InputError);
}

TEST(Polygon, ConvexityCountsTheTurns) {
  std::vector<Vec2> pentagon, pentagram;
  for (int i = 0; i < 5; ++i) {
    pentagon.push_back(unit(0.4 * std::numbers::pi * i));
    pentagram.push_back(unit(0.8 * std::numbers::pi * i));
  }
  EXPECT_TRUE(is_convex(pentagon));
  EXPECT_FALSE(is_convex(pentagram));
  std::reverse(pentagon.begin(), pentagon.end());
  EXPECT_FALSE(is_convex(pentagon));
}

}  // namespace
}  // namespace seine::geom
