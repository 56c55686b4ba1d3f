#include "seine/search/rolling_start.hpp"

#include <gtest/gtest.h>

#include "seine/search/path_planner.hpp"
#include "seine/search/team_guess.hpp"
#include "seine/search/test/path_check.hpp"

namespace seine::search {
namespace {

/// A car at 1.5 m/s towards a wall so far ahead of its bumper's margin; the goal is just behind it.
world::Scenario towards_wall(double room) {
  world::Scenario scenario;
  scenario.bounds = {{-8.0, -8.0}, {8.0, 8.0}};
  scenario.models = {vehicle::Model{.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1)}};
  scenario.margins = {0.05, 0.05};
  const double wall = 0.5 + 0.05 + room;
  scenario.obstacles.push_back(
      {.name = "wall",
       .shape = std::vector<geom::Vec2>{{wall, -3.0}, {wall + 0.2, -3.0}, {wall + 0.2, 3.0}, {wall, 3.0}}});
  scenario.robots.push_back(
      {.name = "car0", .start = {}, .start_speed = 1.5, .goal = geom::Pose2{-1.0, 0.0, 0.0}});
  return scenario;
}

TEST(RollingStart, BrakesBeforeAWallWhereThereIsRoomAndSaysSoWhereNot) {
  const double needed = 1.5 * 1.5 / (2.0 * 3.0);
  for (const double share : {1.05, 1.1, 1.3, 2.0}) {
    const world::Scenario scenario = towards_wall(share * needed);
    const world::StaticMap map(scenario);
    const TeamGuess guess = guess_team(scenario, map, {});
    ASSERT_TRUE(guess.complete) << share << ": " << guess.reason;
    EXPECT_EQ(guess.robots[0].path.points.front().gear, 1);
    EXPECT_GE(smallest_distance(guess.robots[0].path, map, scenario.models[0], 0.002), 0.05 - 1e-4);
  }
  for (const double share : {0.3, 0.6, 0.95}) {
    const world::Scenario scenario = towards_wall(share * needed);
    const TeamGuess guess = guess_team(scenario, world::StaticMap(scenario), {});
    EXPECT_FALSE(guess.complete);
    EXPECT_NE(guess.reason.find("needs 0.375 m to stop"), std::string::npos) << guess.reason;
  }
}

TEST(RollingStart, FollowsOnlyWhatItsSpeedAllows) {
  world::Scenario scenario = towards_wall(5.0);
  scenario.models[0].limits.lateral_acceleration = 3.0;
  const world::StaticMap map(scenario);
  const RollingStart start{&map, &scenario.models[0], {}, 1.5, 0.05};
  const Path straight{{{0.0, {}, 0.0, 1}, {0.4, {0.4, 0.0, 0.0}, 0.0, 1}}};
  EXPECT_TRUE(follows(start, straight, 1.0));
  EXPECT_FALSE(follows(start, straight, 0.9));
  const Path bent{{{0.0, {}, 2.0, 1}, {2.0, {}, 2.0, 1}}};
  EXPECT_FALSE(follows(start, bent, 1.0));
  const Path back{{{0.0, {}, 0.0, -1}, {2.0, {}, 0.0, -1}}};
  EXPECT_FALSE(follows(start, back, 1.0));
}

}  // namespace
}  // namespace seine::search
