#include "seine/world/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace seine::world {
namespace {

using geom::Vec2;

std::vector<Vec2> square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

// Two 0.6 × 0.4 m cars with room about them, and one block.
Scenario good() {
  Scenario s;
  s.bounds = {{0.0, 0.0}, {10.0, 10.0}};
  s.models.push_back(
      {.name = "default", .footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1), .limits = {}});
  s.robots.push_back({.name = "car0", .start = {1.0, 1.0, 0.0}, .goal = geom::Pose2{8.0, 8.0, 0.0}});
  s.robots.push_back({.name = "", .start = {1.0, 3.0, 0.0}, .goal = geom::Pose2{8.0, 6.0, 0.0}});
  s.obstacles.push_back({.name = "block", .shape = square(4.0, 4.0, 1.0), .motion = {}});
  return s;
}

std::vector<std::string> complaints(const Scenario& scenario) {
  return check(scenario, StaticMap(scenario));
}

// Exactly one complaint, and it holds every one of `words`.
void expect_one(const std::function<void(Scenario&)>& spoil, const std::vector<std::string>& words) {
  Scenario scenario = good();
  spoil(scenario);
  const std::vector<std::string> found = complaints(scenario);
  ASSERT_EQ(found.size(), 1U) << (found.empty() ? "no complaint about " + words[0]
                                                : found[0] + " | " + found.back());
  for (const std::string& word : words) EXPECT_NE(found[0].find(word), std::string::npos) << found[0];
}

TEST(Check, AGoodScenarioHasNoComplaint) {
  EXPECT_TRUE(complaints(good()).empty());
}

// A solid region is known by its edge only; whoever stands deep inside it is near nothing.
TEST(Check, AStartDeepInsideASolidRegionOfTheMap) {
  expect_one(
      [](Scenario& s) {
        geom::OccupancyGrid map{.width = 100, .height = 100, .resolution = 0.1, .origin = {}, .occupied = {}};
        map.occupied.assign(10000, 0);
        for (int row = 0; row < 25; ++row)
          for (int column = 0; column < 25; ++column)
            map.occupied[static_cast<std::size_t>(100 * row + column)] = 1;
        s.map = map;
      },
      {"car0", "start", "blocked cell"});
}

TEST(Check, NumbersThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_one([](Scenario& s) { s.robots.clear(); }, {"empty"});
  expect_one([](Scenario& s) { s.models[0].wheelbase = 0.0; }, {"wheelbase", "default", "is 0"});
  expect_one([](Scenario& s) { s.models[0].limits.speed = -1.0; }, {"speed limit", "-1"});
  expect_one([](Scenario& s) { s.models[0].limits.reverse_speed = -1.0; }, {"reverse speed limit"});
  expect_one([nan](Scenario& s) { s.models[0].limits.acceleration = nan; }, {"acceleration limit", "nan"});
  expect_one([](Scenario& s) { s.models[0].limits.lateral_acceleration = 0.0; }, {"lateral"});
  expect_one([](Scenario& s) { s.models[0].limits.steering = 1.6; }, {"steering limit", "1.6"});
  expect_one([](Scenario& s) { s.models[0].limits.steering_rate = 0.0; }, {"steering rate"});
  expect_one([](Scenario& s) { s.margins.robot = -0.1; }, {"margin between robots", "-0.1"});
  expect_one([nan](Scenario& s) { s.margins.obstacle = nan; }, {"margin to obstacles", "nan"});
  expect_one(
      [](Scenario& s) {
        s.models[0].footprint = {{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
      },
      {"not convex"});
  expect_one([](Scenario& s) { std::reverse(s.models[0].footprint.begin(), s.models[0].footprint.end()); },
             {"clockwise"});
  expect_one([](Scenario& s) { s.robots[0].start_speed = 2.6; }, {"car0", "2.6", "2.5"});
  expect_one([](Scenario& s) { s.robots[1].start_speed = -2.6; }, {"robot 2", "-2.6"});
  expect_one([](Scenario& s) { s.robots[0].model = 3; }, {"car0", "model number 3"});
  expect_one([nan](Scenario& s) { s.robots[0].goal->heading = nan; }, {"car0", "goal", "not finite"});
  expect_one([](Scenario& s) { s.obstacles[0].shape = Circle{{5.0, 5.0}, 0.0}; }, {"radius of block"});
  expect_one([](Scenario& s) { s.obstacles[0].motion = {{1.0, {}}, {1.0, {}}}; }, {"waypoint 2 of block"});
}

TEST(Check, PlacesThatAreTaken) {
  expect_one(
      [](Scenario& s) {
        s.robots[0].start = {3.0, 4.5, 0.0};
        s.robots[0].start.x = 3.6;
      },
      {"car0 at its start overlaps block by 0.1 m"});
  expect_one(
      [](Scenario& s) {
        s.robots[0].goal = geom::Pose2{3.47, 4.5, 0.0};
      },
      {"car0 at its goal is 0.03 m from block", "margin of 0.05 m"});
  expect_one(
      [](Scenario& s) {
        s.robots[0].start = {0.05, 1.0, 0.0};
      },
      {"car0 at its start sticks out of the bounds by 0.05 m"});
  expect_one([](Scenario& s) { s.robots[0].start = {0.12, 1.0, 0.0}; }, {"0.02 m from the bounds"});
  expect_one(
      [](Scenario& s) {
        s.robots[1].start = {1.5, 1.0, 0.0};
      },
      {"car0 at its start overlaps robot 2 at its start by 0.1 m"});
  expect_one(
      [](Scenario& s) {
        s.robots[1].goal = geom::Pose2{8.62, 8.0, 0.0};
      },
      {"car0 at its goal is 0.02 m from robot 2 at its goal"});
}

TEST(Check, AnObstacleOfManyPiecesIsOneComplaintAndTheMapHasAPlace) {
  expect_one(
      [](Scenario& s) {
        s.obstacles[0].shape = std::vector<Vec2>{{4, 4}, {6, 4}, {6, 6}, {5, 4.5}, {4, 6}};
        s.robots[0].start = {4.7, 4.3, 0.0};
      },
      {"overlaps block"});
  expect_one(
      [](Scenario& s) {
        s.map = geom::OccupancyGrid{.width = 20,
                                    .height = 20,
                                    .resolution = 0.5,
                                    .origin = {},
                                    .occupied = std::vector<std::uint8_t>(400, 0)};
        s.map->occupied[2 * 20 + 2] = 1;
      },
      {"car0 at its start overlaps the map at (1.25, 1.25)"});
}

TEST(Check, MovingObstaclesAtTheirBeginningAndEnd) {
  const auto moving = [](double x0, double x1) {
    return [x0, x1](Scenario& s) {
      Obstacle cart{.name = "cart", .shape = square(-0.5, -0.5, 1.0), .motion = {}};
      cart.motion = {{-1.0, {x0 - 1.0, 3.0, 0.0}}, {1.0, {x0 + 1.0, 3.0, 0.0}}, {9.0, {x1, 6.0, 0.0}}};
      s.obstacles.push_back(cart);
    };
  };
  expect_one(moving(1.2, 5.0), {"robot 2 at its start overlaps cart (moving, at t = 0)"});
  expect_one(moving(4.0, 8.2),
             {"the goal of robot 2 is blocked from t = ", " s on by cart, which comes to rest on it"});
  Scenario fine = good();
  moving(4.0, 5.0)(fine);
  EXPECT_TRUE(complaints(fine).empty());
}

TEST(Check, WithoutAMarginTouchingIsAllowed) {
  Scenario s = good();
  s.margins = {0.0, 0.0};
  s.robots[0].start = {0.1, 1.0, 0.0};                   // against the bounds
  s.robots[1].start = {0.7 + 5e-7, 1.0, 0.0};            // against the other car
  s.robots[0].goal = geom::Pose2{3.5 + 5e-7, 4.5, 0.0};  // into the block by less than the tolerance
  EXPECT_TRUE(complaints(s).empty());
  s.robots[0].goal->x += 2e-6;
  EXPECT_EQ(complaints(s).size(), 1U);
}

TEST(Check, ScenariosBuiltInCodeAreLookedAt) {
  EXPECT_NO_THROW(expect_numbers(good()));
  Scenario bad = good();
  bad.robots[0].model = -1;
  EXPECT_THROW(expect_numbers(bad), Unsound);
  bad = good();
  bad.robots[0].start.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(expect_numbers(bad), Unsound);
  bad = good();
  bad.margins.robot = -1.0;
  EXPECT_THROW(expect_numbers(bad), Unsound);
  bad = good();
  bad.map = geom::OccupancyGrid{.width = 40, .height = 40, .resolution = 0.1, .origin = {}, .occupied = {}};
  bad.map->occupied.assign(7, 1);
  EXPECT_THROW(StaticMap{bad}, InputError);
}

TEST(Check, SaysWhosePlaceItIsAndWhatOnlyHasNoAnswer) {
  Scenario scenario = good();
  const geom::Pose2 goal = *scenario.robots[1].goal;
  Obstacle mover{.name = "van", .shape = Circle{{}, 0.3}, .motion = {}};
  mover.motion = {{0.0, {goal.x, goal.y + 3.0, 0.0}}, {4.0, goal}};
  scenario.obstacles.push_back(mover);
  const StaticMap map(scenario);
  const Complaints found = examine(scenario, map);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].robot, 1);
  EXPECT_TRUE(found[0].goal);
  EXPECT_TRUE(found[0].impossible);
  EXPECT_NE(expect_sound(scenario, map).find("van"), std::string::npos);
  scenario.robots[0].start = scenario.robots[1].start;
  try {
    expect_sound(scenario, StaticMap(scenario));
    FAIL();
  } catch (const Unsound& unsound) {
    EXPECT_FALSE(unsound.complaints().front().goal);
    EXPECT_EQ(unsound.complaints().front().robot, 0);
  }
}

}  // namespace
}  // namespace seine::world
