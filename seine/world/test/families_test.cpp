#include "seine/world/families.hpp"

#include <gtest/gtest.h>

#include <string>

#include "seine/base/error.hpp"
#include "seine/world/check.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {
namespace {

std::string complaints(const Scenario& scenario) {
  std::string all;
  for (const std::string& complaint : check(scenario, StaticMap(scenario))) all += complaint + "\n";
  return all;
}

double distance(const geom::Pose2& a, const geom::Pose2& b) {
  return geom::norm(a.position() - b.position());
}

TEST(Families, EveryInstanceIsAValidQuestion) {
  for (const Family family : all_families()) {
    for (const int robots : {1, 2, 3, 8, 20, 26, 50, 100}) {
      for (const std::uint64_t seed : {0U, 1U, 77U}) {
        const Scenario scenario = generate(family, robots, seed);
        ASSERT_EQ(scenario.robots.size(), static_cast<std::size_t>(robots)) << scenario.name;
        EXPECT_EQ(complaints(scenario), "") << scenario.name;
      }
    }
  }
}

TEST(Families, TheSeedDecidesEverything) {
  for (const Family family : all_families()) {
    const Scenario a = generate(family, 9, 5), b = generate(family, 9, 5), c = generate(family, 9, 6);
    for (std::size_t k = 0; k < a.robots.size(); ++k) {
      EXPECT_EQ(a.robots[k].start, b.robots[k].start);
      EXPECT_EQ(a.robots[k].goal, b.robots[k].goal);
    }
    EXPECT_NE(a.robots[0].start, c.robots[0].start) << name_of(family);
  }
}

TEST(Families, NamesGoBothWays) {
  for (const Family family : all_families()) EXPECT_EQ(family_named(name_of(family)), family);
  EXPECT_FALSE(family_named("rondom"));
}

TEST(Families, RandomKeepsWhatItPromises) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenario scenario = generate(Family::random, 26, seed);
    EXPECT_EQ(scenario.bounds.size(), (geom::Vec2{20.0, 20.0}));
    EXPECT_EQ(scenario.obstacles.size(), 20U);
    for (const Robot& robot : scenario.robots) {
      const geom::Vec2 way = robot.goal->position() - robot.start.position();
      EXPECT_GE(geom::norm(way), 9.2);
      EXPECT_LE(geom::norm(way), 11.2);
      const double angle = std::atan2(way.y, way.x);
      EXPECT_LE(std::abs(geom::wrap_angle(robot.start.heading - angle)), 0.8);
      EXPECT_LE(std::abs(geom::wrap_angle(robot.goal->heading - angle)), 0.8);
      for (const Robot& other : scenario.robots) {
        if (&other == &robot) continue;
        EXPECT_GE(distance(robot.start, other.start), 1.3);
        EXPECT_GE(distance(*robot.goal, *other.goal), 1.3);
      }
    }
  }
}

TEST(Families, LargeTeamsHaveTheSameRoomEach) {
  for (const int robots : {50, 100}) {
    const geom::Vec2 size = generate(Family::random, robots, 1).bounds.size();
    EXPECT_NEAR(robots / (size.x * size.y), 0.05, 1e-9);
  }
}

TEST(Families, CrowdedRequestsEndInALargerWorld) {
  const Scenario scenario = generate(Family::random, 4, 3, {.obstacles = 200});
  EXPECT_EQ(scenario.obstacles.size(), 200U);
  EXPECT_GT(scenario.bounds.size().x, 20.0);
}

TEST(Families, NonsenseIsRefused) {
  EXPECT_THROW(generate(Family::swap, 0, 1), InputError);
  EXPECT_THROW(generate(Family::swap, 4, 1, {.obstacles = 3}), InputError);
  EXPECT_THROW(generate(Family::random, 4, 1, {.obstacles = -3}), InputError);
}

/// Two rooms 10 × 10 m joined by a door 1.4 m wide, in a turned frame.
geom::OccupancyGrid two_rooms() {
  geom::OccupancyGrid map{
      .width = 200, .height = 100, .resolution = 0.1, .origin = {3.0, -2.0, 0.4}, .occupied = {}};
  map.occupied.assign(200 * 100, 0);
  for (std::size_t row = 0; row < 100; ++row) {
    if (row < 43 || row >= 57) map.occupied[row * 200 + 100] = 1;
  }
  return map;
}

TEST(OnMap, TeamsStandFreeAndFarFromTheirGoals) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scenario scenario = on_map(two_rooms(), 4, seed);
    EXPECT_EQ(complaints(scenario), "");
    for (const Robot& robot : scenario.robots) EXPECT_GT(distance(robot.start, *robot.goal), 1.0);
    EXPECT_EQ(on_map(two_rooms(), 4, seed).robots[3].goal, scenario.robots[3].goal);
  }
}

TEST(OnMap, AMapWithoutRoomIsRefused) {
  geom::OccupancyGrid closet{.width = 20, .height = 20, .resolution = 0.1, .origin = {}, .occupied = {}};
  closet.occupied.assign(400, 0);
  EXPECT_THROW(on_map(closet, 4, 1), InputError);
}

}  // namespace
}  // namespace seine::world
