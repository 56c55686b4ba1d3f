#include "seine/search/swept_footprint.hpp"

#include <gtest/gtest.h>

#include "seine/base/rng.hpp"
#include "seine/geom/convex.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::search {
namespace {

std::vector<geom::Vec2> random_polygon(Rng& rng) {
  if (rng.below(3) == 0)
    return vehicle::rectangle_footprint(rng.uniform(0.3, 2.0), rng.uniform(0.2, 1.0), 0.1);
  std::vector<geom::Vec2> points;
  for (int i = 0; i < 9; ++i) points.push_back({rng.uniform(-0.5, 1.0), rng.uniform(-0.5, 0.5)});
  return geom::convex_hull(points);
}

geom::Pose2 random_pose(Rng& rng) {
  return {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
}

double depth_inside(std::span<const geom::Vec2> polygon, geom::Vec2 p) {
  double least = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const geom::Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    least = std::min(least, cross(edge, p - polygon[i]) / norm(edge));
  }
  return least;
}

TEST(SweptFootprint, ContainsWhatIsReachedWithinTheSlack) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const std::vector<geom::Vec2> body = random_polygon(rng);
    const SweptFootprint swept(body);
    const Slack slack{rng.uniform(0.0, 0.3), rng.uniform(0.0, 0.3), rng.uniform(0.0, 2.2)};
    const geom::Pose2 pose = random_pose(rng);
    std::vector<geom::Vec2> cover(swept.corners());
    const OrientedBox box = swept.cover(pose, slack, cover);
    EXPECT_GT(depth_inside(cover, 0.25 * (cover[0] + cover[1] + cover[2] + cover[3 % cover.size()])), -1e-9);
    const geom::Pose2 there = vehicle::drive(pose, rng.uniform(-slack.curvature, slack.curvature),
                                             rng.uniform(-slack.behind, slack.ahead));
    for (const geom::Vec2 corner : geom::placed({body, 0.0}, there).core)
      EXPECT_GE(depth_inside(cover, corner), -1e-9);
    for (const geom::Vec2 corner : cover) {
      EXPECT_LE(std::abs(dot(corner - box.center, box.axis)), box.half_length + 1e-9);
      EXPECT_LE(std::abs(cross(box.axis, corner - box.center)), box.half_width + 1e-9);
    }
  }
}

TEST(SweptFootprint, ApartAgreesWithExactDistances) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const std::vector<geom::Vec2> a = random_polygon(rng), b = random_polygon(rng);
    const SweptFootprint swept_a(a), swept_b(b);
    std::vector<geom::Vec2> at(swept_a.corners()), bt(swept_b.corners());
    const geom::Pose2 p = random_pose(rng), q = vehicle::drive(p, rng.uniform(-1, 1), rng.uniform(-2, 2));
    const OrientedBox box_a = swept_a.grow(p, rng.below(2) * rng.uniform(0, 0.2), at),
                      box_b = swept_b.grow(q, rng.below(2) * rng.uniform(0, 0.2), bt);
    const double exact = geom::distance(at, bt), clearance = rng.uniform(0.0, 0.3);
    if (std::abs(exact - clearance) < 1e-5) continue;
    EXPECT_EQ(apart(at, bt, clearance), exact >= clearance);
    const Standing boxes = standing(box_a, box_b, clearance);
    if (boxes == Standing::kApart) {
      EXPECT_GE(exact, clearance - 1e-9);
    }
    if (swept_a.is_box() && swept_b.is_box()) {
      EXPECT_EQ(boxes == Standing::kOverlap, exact <= 0.0);
      if (exact > 0.0) {
        EXPECT_NEAR(std::sqrt(squared_distance(box_a, box_b)), exact, 1e-9);
      }
    }
  }
}

TEST(SweptFootprint, TouchingIsApartAtMarginZero) {
  const std::vector<geom::Vec2> a{{0, 0}, {3, 0}, {3, 2}, {0, 2}}, b{{0, 2}, {3, 2}, {3, 4}, {0, 4}};
  EXPECT_TRUE(apart(a, b, 0.0));
  EXPECT_FALSE(apart(a, b, 0.01));
}

}  // namespace
}  // namespace seine::search
