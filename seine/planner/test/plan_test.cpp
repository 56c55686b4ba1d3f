#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/deadline.hpp"
#include "seine/base/effort.hpp"
#include "seine/base/error.hpp"
#include "seine/geom/convex.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {
namespace {

constexpr int kSeeds = effort(5, 1);
constexpr double kStep = 1.0 / effort(500, 50);  // s

// What a stranger with a stopwatch and a ruler would find: every limit and every distance, at many instants,
// without the certificate.
void expect_kept(const world::Scenario& scenario, const traj::TeamTrajectory& plan) {
  const world::StaticMap map(scenario);
  std::vector<std::vector<geom::Vec2>> footprints(scenario.robots.size());
  for (double t = 0.0; t < plan.makespan() + 0.1; t += kStep) {
    for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
      const vehicle::Model& model = scenario.model_of(scenario.robots[k]);
      const traj::State s = plan.robots[k].at(t);
      ASSERT_LE(s.speed, model.limits.speed * (1 + 1e-6)) << "car " << k << " at " << t;
      ASSERT_GE(s.speed, -model.limits.reverse_speed * (1 + 1e-6)) << "car " << k << " at " << t;
      ASSERT_LE(std::abs(s.acceleration), model.limits.acceleration * (1 + 1e-6))
          << "car " << k << " at " << t;
      ASSERT_LE(std::abs(s.lateral_acceleration), model.limits.lateral_acceleration * (1 + 1e-6))
          << "car " << k << " at " << t;
      ASSERT_LE(std::abs(s.curvature), model.max_curvature() * (1 + 1e-6)) << "car " << k << " at " << t;
      footprints[k].resize(model.footprint.size());
      geom::place(model.footprint, s.pose, footprints[k]);
      ASSERT_TRUE(map.clear(footprints[k], scenario.margins.obstacle - 2e-4)) << "car " << k << " at " << t;
      for (std::size_t j = 0; j < k; ++j)
        ASSERT_GE(geom::distance(footprints[k], footprints[j]), scenario.margins.robot - 2e-4)
            << k << ", " << j << " at " << t;
    }
  }
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const world::Robot& robot = scenario.robots[k];
    const traj::State first = plan.robots[k].at(0.0), last = plan.robots[k].at(plan.makespan());
    EXPECT_NEAR(geom::norm(first.pose.position() - robot.start.position()), 0.0, 1e-6);
    EXPECT_NEAR(first.speed, robot.start_speed, 1e-6);
    EXPECT_NEAR(geom::norm(last.pose.position() - robot.goal->position()), 0.0, 1e-6);
    EXPECT_NEAR(geom::wrap_angle(last.pose.heading - robot.goal->heading), 0.0, 1e-6);
    EXPECT_NEAR(last.speed, 0.0, 1e-6);
  }
}

TEST(Plan, OfEveryFamilyIsCertifiedAndKeepsEverythingAStrangerMeasures) {
  for (const world::Family family : world::all_families())
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const world::Scenario scenario = world::generate(family, 6, seed);
      const PlanResult result = plan(scenario);
      ASSERT_TRUE(result.certified) << world::name_of(family) << ", seed " << seed << ": " << result.reason;
      expect_kept(scenario, result.plan);
      EXPECT_GT(result.quality.acceleration_cost, 0.0);
      EXPECT_GE(result.quality.makespan, result.quality.mean_travel);
    }
}

world::Scenario open_field() {
  world::Scenario scenario;
  scenario.name = "open-field";
  scenario.bounds = {{-2.0, -4.0}, {14.0, 4.0}};
  scenario.models = {world::standard_car()};
  return scenario;
}

world::Robot robot(const char* name, geom::Pose2 start, geom::Pose2 goal, double speed = 0.0) {
  return {.name = name, .model = 0, .start = start, .start_speed = speed, .goal = goal};
}

TEST(Plan, StartsAtTheSpeedTheCarHasForwardsAndBackwards) {
  for (const double speed : {1.7, -0.9}) {
    world::Scenario scenario = open_field();
    scenario.robots = {robot("a", {2.0, 0.0, 0.2}, {9.0, 1.0, 0.0}, speed)};
    const PlanResult result = plan(scenario);
    ASSERT_TRUE(result.certified) << "speed " << speed << ": " << result.reason;
    expect_kept(scenario, result.plan);
  }
}

// A way to stop is shorter than a step of the velocity plan where the car creeps.
TEST(Plan, StopsFromAnySpeedBeforeItTurnsBack) {
  for (const double speed : {0.001, 0.02, 0.1, 0.25, 0.4, 0.9, 2.0}) {
    for (const double way : {1.0, -1.0}) {
      world::Scenario scenario = open_field();
      scenario.robots = {robot("a", {2.0, 0.0, 0.0}, {2.0 - way, 0.0, 0.05}, way * speed)};
      const PlanResult result = plan(scenario);
      ASSERT_TRUE(result.certified) << "speed " << way * speed << ": " << result.reason;
      EXPECT_LT(result.plan.makespan(), 6.0) << "speed " << way * speed;
    }
  }
}

TEST(Plan, AvoidsWhatMoves) {
  world::Scenario scenario = open_field();
  scenario.robots = {robot("a", {0.0, 0.0, 0.0}, {10.0, 0.0, 0.0})};
  world::Obstacle crossing{.name = "cart", .shape = world::Circle{{0.0, 0.0}, 0.5}};
  crossing.motion = {{0.0, {5.0, -3.0, 0.0}}, {4.5, {5.0, 3.0, 0.0}}};
  scenario.obstacles = {crossing};
  const PlanResult result = plan(scenario);
  ASSERT_TRUE(result.certified) << result.reason;
  std::vector<geom::Vec2> footprint(4);
  for (double t = 0.0; t < 6.0; t += kStep) {
    geom::place(scenario.models[0].footprint, result.plan.robots[0].at(t).pose, footprint);
    const std::vector<geom::Vec2> center{{5.0, -3.0 + 6.0 * std::min(t, 4.5) / 4.5}};
    ASSERT_GE(geom::distance(footprint, center) - 0.5, scenario.margins.obstacle - 2e-4) << "at " << t;
  }
}

TEST(Plan, IsTheSameForAnyNumberOfThreads) {
  const world::Scenario scenario = world::generate(world::Family::random, 10, 3);
  std::vector<traj::TeamTrajectory> plans;
  for (const int threads : {1, 2}) plans.push_back(plan(scenario, {.threads = threads}).plan);
  for (std::size_t k = 0; k < scenario.robots.size(); ++k)
    for (double t = 0.0; t < 8.0; t += 0.1) {
      const traj::State a = plans[0].robots[k].at(t), b = plans[1].robots[k].at(t);
      ASSERT_EQ(a.pose, b.pose) << "car " << k << " at " << t;
      ASSERT_EQ(a.speed, b.speed);
    }
}

TEST(Plan, SaysNoWithAReasonWhereThereIsNoWay) {
  world::Scenario scenario = open_field();
  scenario.robots = {robot("a", {0.0, 0.0, 0.0}, {10.0, 0.0, 0.0})};
  scenario.obstacles = {
      {.name = "wall", .shape = std::vector<geom::Vec2>{{5.0, -4.0}, {5.5, -4.0}, {5.5, 4.0}, {5.0, 4.0}}}};
  const PlanResult result = plan(scenario);
  EXPECT_FALSE(result.certified);
  EXPECT_NE(result.reason.find("a"), std::string::npos) << result.reason;
}

TEST(Plan, RefusesAScenarioThatIsWrongInItself) {
  world::Scenario scenario = open_field();
  EXPECT_THROW(plan(scenario), InputError);
  scenario.robots = {robot("a", {0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}),
                     robot("b", {0.3, 0.1, 0.0}, {10.0, 2.0, 0.0})};
  EXPECT_THROW(plan(scenario), InputError);
}

}  // namespace
}  // namespace seine::planner
