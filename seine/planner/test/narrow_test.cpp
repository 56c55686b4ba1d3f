#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "seine/planner/planner.hpp"
#include "seine/vehicle/catalogue.hpp"

namespace seine::planner {
namespace {

constexpr double kPi = std::numbers::pi;

world::Obstacle block(double x0, double y0, double x1, double y1) {
  world::Obstacle obstacle;
  obstacle.shape = std::vector<geom::Vec2>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return obstacle;
}

// Two cars nose to nose on the x axis that want to change places.
world::Scenario swap_in(const geom::Box& bounds, double reach) {
  world::Scenario scenario;
  scenario.bounds = bounds;
  scenario.models = {*vehicle::catalogued("letter")};
  world::Robot robot;
  robot.name = "a", robot.start = {-reach, 0.0, 0.0}, robot.goal = geom::Pose2{reach - 0.4, 0.0, 0.0};
  scenario.robots.push_back(robot);
  robot.name = "b", robot.start = {reach, 0.0, kPi}, robot.goal = geom::Pose2{0.4 - reach, 0.0, kPi};
  scenario.robots.push_back(robot);
  return scenario;
}

TEST(NarrowPlaces, ALaneWithoutABayIsProvedImpossible) {
  const world::Scenario scenario = swap_in({{-6.0, -0.3}, {6.0, 0.3}}, 4.0);
  const PlanResult result = plan(scenario, {.threads = 1});
  EXPECT_FALSE(result.certified);
  EXPECT_TRUE(result.impossible);
  EXPECT_NE(result.reason.find("proved"), std::string::npos) << result.reason;
}

TEST(NarrowPlaces, OneOfTwoGoesIntoASideRoad) {
  world::Scenario scenario = swap_in({{-6.0, -6.0}, {6.0, 6.0}}, 4.0);
  for (const double x : {-6.0, 0.4})
    for (const double y : {-6.0, 0.4})
      scenario.obstacles.push_back(block(x, y, x < 0.0 ? -0.4 : 6.0, y < 0.0 ? -0.4 : 6.0));
  const PlanResult result = plan(scenario, {.threads = 1});
  EXPECT_TRUE(result.certified) << result.reason;
}

// The inner one wants out of a dead end, the outer one wants to its inner end.
TEST(NarrowPlaces, TheOuterOneLetsTheInnerOneOut) {
  world::Scenario scenario = swap_in({{-4.0, -2.0}, {2.5, 2.0}}, 1.0);
  scenario.obstacles = {block(0.0, 0.31, 2.5, 2.0), block(0.0, -2.0, 2.5, -0.31)};
  scenario.robots[0].start = {1.8, 0.0, 0.0}, scenario.robots[0].goal = geom::Pose2{-2.5, 1.0, 0.0};
  scenario.robots[1].start = {0.9, 0.0, 0.0}, scenario.robots[1].goal = geom::Pose2{1.8, 0.0, 0.0};
  const PlanResult result = plan(scenario, {.threads = 1});
  EXPECT_TRUE(result.certified) << result.reason;
}

}  // namespace
}  // namespace seine::planner
