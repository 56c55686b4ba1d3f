#include "seine/world/frame.hpp"

#include <gtest/gtest.h>

#include "seine/world/check.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {
namespace {

TEST(Frame, IsTheOriginNearIt) {
  const Scenario near = generate(Family::random, 4, 1);
  EXPECT_FALSE(local_origin(near));
  const Scenario far = seen_from(near, {-448125.0, -5411825.0});
  const auto origin = local_origin(far);
  ASSERT_TRUE(origin);
  EXPECT_EQ(origin->x, 448125.0 + near.bounds.center().x);
  const Scenario back = seen_from(far, *origin);
  EXPECT_EQ(back.origin + geom::Vec2{}, *origin + far.origin);
  EXPECT_TRUE(check(far, StaticMap(far)).empty());
  EXPECT_TRUE(check(back, StaticMap(back)).empty());
}

TEST(Frame, MovesEverythingAlike) {
  Scenario s = generate(Family::random, 2, 3);
  s.map = geom::OccupancyGrid{2, 2, 0.5, {3.0, 4.0, 0.3}, {0, 1, 0, 0}};
  s.obstacles.push_back(
      {.name = "moving", .shape = Circle{{}, 0.2}, .motion = {{0.0, {1, 2, 0}}, {1.0, {2, 2, 0}}}});
  const Scenario moved = seen_from(s, {16.0, -32.0});
  const StaticMap a(s), b(moved);
  ASSERT_EQ(a.pieces().size(), b.pieces().size());
  for (std::size_t i = 0; i < a.pieces().size(); ++i) {
    EXPECT_NEAR(a.pieces()[i].box.low.x - 16.0, b.pieces()[i].box.low.x, 1e-7);
    EXPECT_NEAR(a.pieces()[i].box.high.y + 32.0, b.pieces()[i].box.high.y, 1e-7);
    EXPECT_EQ(a.describe(static_cast<int>(i)), b.describe(static_cast<int>(i)));
  }
  EXPECT_EQ(moved.obstacles.back().motion[1].pose.x, -14.0);
  EXPECT_NEAR(moved.robots[1].goal->y, s.robots[1].goal->y + 32.0, 1e-7);
}

TEST(Frame, OfNumbersWithFewDecimalsIsTheSameAnywhere) {
  Scenario s;
  s.bounds = {{-8, -8}, {8, 8}};
  s.robots = {{.name = "a", .start = {-1.5, -4.8, 0.3}, .goal = geom::Pose2{6.5, 0.1234567, 0}}};
  for (const geom::Vec2 by : {geom::Vec2{448125.0, 5411825.0}, {300000.25, 9999000.7}, {-2e7, 1234567.891}}) {
    Scenario far = s;
    far.bounds = {far.bounds.low + by, far.bounds.high + by};
    far.robots[0].start.x += by.x, far.robots[0].start.y += by.y;
    far.robots[0].goal->x += by.x, far.robots[0].goal->y += by.y;
    const Scenario back = seen_from(far, *local_origin(far));
    EXPECT_EQ(back.robots[0].start, s.robots[0].start);
    EXPECT_EQ(*back.robots[0].goal, *s.robots[0].goal);
    EXPECT_EQ(back.bounds.low, s.bounds.low);
  }
}

}  // namespace
}  // namespace seine::world
