#include "seine/search/path_planner.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "seine/base/rng.hpp"
#include "seine/search/test/path_check.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

constexpr std::uint64_t kSeed = 7;

world::Obstacle box(double low_x, double low_y, double high_x, double high_y) {
  world::Obstacle obstacle;
  obstacle.shape =
      std::vector<geom::Vec2>{{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}};
  return obstacle;
}

world::Scenario empty_world(double size) {
  world::Scenario scenario;
  scenario.bounds = {{0, 0}, {size, size}};
  scenario.models = {world::standard_car()};
  return scenario;
}

PathOptions with_clearance(double clearance) {
  PathOptions options;
  options.clearance = clearance;
  return options;
}

/// Plans every robot of the scenario by itself; returns how many have a path.
int plan_all(const world::Scenario& scenario) {
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  int found = 0;
  for (const world::Robot& robot : scenario.robots) {
    const auto path = planner.plan(robot.start, *robot.goal, with_clearance(scenario.margins.obstacle));
    if (!path) continue;
    ++found;
    expect_sound(*path, robot.start, *robot.goal, map, scenario.models[0], scenario.margins.obstacle);
  }
  return found;
}

class Families : public testing::TestWithParam<world::Family> {};

TEST_P(Families, EveryCarHasASoundPath) {
  for (std::uint64_t seed = kSeed; seed < kSeed + 5; ++seed) {
    SCOPED_TRACE(seed);
    const auto scenario = world::generate(GetParam(), 14, seed);
    EXPECT_EQ(plan_all(scenario), static_cast<int>(scenario.robots.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Families,
                         testing::ValuesIn(world::all_families().begin(), world::all_families().end()),
                         [](const auto& what) { return std::string(world::name_of(what.param)); });

TEST(PathPlanner, OpenGroundIsDrivenStraight) {
  const auto scenario = empty_world(10);
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  const auto path = planner.plan({1, 5, 0}, {9, 5, 0}, {});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->length(), 8.0, 1e-9);
  const auto there = planner.plan({1, 5, 0}, {1, 5, 0}, {});
  ASSERT_TRUE(there);
  EXPECT_EQ(there->points.size(), 1u);
}

TEST(PathPlanner, StretchesAreNotShorterThanTheyNeedToBe) {
  SCOPED_TRACE(kSeed);
  const auto scenario = empty_world(12);
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  Rng rng(kSeed);
  const double length = scenario.models[0].length();
  int stubs = 0;
  for (int i = 0; i < 200; ++i) {
    const auto pose = [&] {
      return geom::Pose2{rng.uniform(4, 8), rng.uniform(4, 8), rng.uniform(-3.1, 3.1)};
    };
    const geom::Pose2 start = pose(), goal = pose();
    const auto path = planner.plan(start, goal, {.short_moves = false});
    ASSERT_TRUE(path);
    expect_sound(*path, start, goal, map, scenario.models[0], 0.05);
    if (gear_changes(*path) > 0 && shortest_stretch(*path) < 0.3 * length) ++stubs;
  }
  EXPECT_LE(stubs, 4);
}

TEST(PathPlanner, BumpsAreDrivenAround) {
  const auto scenario = empty_world(10);
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  const std::vector<Bump> bumps{{{5, 5}, 1.3, 2.5}};
  PathOptions options;
  options.bumps = bumps;
  const auto path = planner.plan({1, 5, 0}, {9, 5, 0}, options);
  ASSERT_TRUE(path);
  double nearest = 9.0;
  for (const PathPoint& p : path->points)
    nearest = std::min(nearest, geom::norm(p.pose.position() - bumps[0].center));
  EXPECT_GT(nearest, 0.6);
  EXPECT_LT(path->length(), 9.5);
}

TEST(PathPlanner, ParkedCarsAreObstaclesUnlessTheyTouchTheEnds) {
  const auto scenario = empty_world(10);
  const world::StaticMap map(scenario);
  const vehicle::Model& car = scenario.models[0];
  const PathPlanner planner(map, car);
  const geom::Pose2 start{1, 5, 0}, goal{9, 5, 0};
  std::vector<std::vector<geom::Vec2>> parked;
  for (const double y : {4.2, 5.0, 5.8}) parked.push_back(geom::placed({car.footprint}, {5, y, 1.5}).core);
  parked.push_back(geom::placed({car.footprint}, {9.2, 5.1, 0.3}).core);  // on the goal
  PathOptions options;
  options.parked = parked;
  options.parked_clearance = 0.07;
  const auto path = planner.plan(start, goal, options);
  ASSERT_TRUE(path);
  expect_sound(*path, start, goal, map, car, 0.05);
  std::vector<geom::Vec2> polygon(car.footprint.size());
  for (double s = 0.0; s < path->length(); s += 0.002) {
    geom::place(car.footprint, pose_at(*path, s), polygon);
    for (int k = 0; k < 3; ++k) EXPECT_GE(geom::distance(polygon, parked[static_cast<std::size_t>(k)]), 0.07);
  }
}

TEST(PathPlanner, SaysNoWhenWalledIn) {
  auto scenario = empty_world(40);
  scenario.obstacles = {box(1, 1, 4, 1.02), box(1, 4, 4, 4.02), box(1, 1, 1.02, 4), box(4, 1, 4.02, 4.02)};
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  EXPECT_FALSE(planner.plan({2.5, 2.5, 0}, {30, 30, 0}, {}));
  EXPECT_FALSE(planner.plan({30, 30, 0}, {2.5, 2.5, 0}, {}));
}

TEST(PathPlanner, SaysNoToEndsThatAreNotClear) {
  auto scenario = empty_world(10);
  scenario.obstacles = {box(4, 4, 5, 5)};
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  EXPECT_FALSE(planner.plan({1, 1, 0}, {4.5, 4.5, 0}, {}));
  EXPECT_FALSE(planner.plan({3.47, 4.5, 0}, {1, 1, 0}, {}));  // 3 cm from the wall, 5 asked for
  EXPECT_FALSE(planner.plan({0.12, 1, 0}, {8, 8, 0}, {}));    // 2 cm from the bounds
  EXPECT_TRUE(planner.plan({3.47, 4.5, 0}, {1, 1, 0}, with_clearance(0.01)));
}

TEST(PathPlanner, StopsAtTheDeadline) {
  const auto scenario = world::generate(world::Family::random, 8, kSeed);
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  PathOptions options;
  options.deadline = Deadline(0.0);
  for (const auto& robot : scenario.robots)
    planner.plan(robot.start, *robot.goal, options);  // any answer, soon
}

TEST(PathPlanner, TheSamePathInAnyOrderAndFromAnyThread) {
  const auto scenario = world::generate(world::Family::random, 20, kSeed);
  const world::StaticMap map(scenario);
  const auto options = with_clearance(scenario.margins.obstacle);
  std::vector<Path> alone;
  for (const auto& robot : scenario.robots) {
    alone.push_back(PathPlanner(map, scenario.models[0]).plan(robot.start, *robot.goal, options).value());
  }
  const PathPlanner shared(map, scenario.models[0]);
  std::vector<std::vector<Path>> found(2);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 2; ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < 2; ++round) {
        found[t].clear();
        for (const auto& robot : scenario.robots)
          found[t].push_back(*shared.plan(robot.start, *robot.goal, options));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    expect_equal(found[0][i], alone[i]);
    expect_equal(found[1][i], alone[i]);
  }
}

}  // namespace
}  // namespace seine::search
