#include <gtest/gtest.h>

#include "seine/base/error.hpp"
#include "seine/baseline/letter/letter.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::baseline::letter {
namespace {

world::Scenario four_cars() {
  return world::generate(world::Family::random, 4, 3, {.obstacles = 4});
}

TEST(LetterPlan, StandsByItsPlanThatTheCertificateRefusesForItsRests) {
  const world::Scenario scenario = four_cars();
  const planner::PlanResult result = plan(scenario);
  ASSERT_TRUE(result.claimed.has_value());
  EXPECT_TRUE(*result.claimed) << result.reason;
  EXPECT_FALSE(result.certified);
  EXPECT_NE(result.reason.find("start speed"), std::string::npos) << result.reason;
  for (const certify::Violation& v : result.certificate.violations) {
    EXPECT_NE(v.kind, certify::Kind::malformed) << v.text;
    EXPECT_NE(v.kind, certify::Kind::continuity) << v.text;
    EXPECT_NE(v.kind, certify::Kind::goal) << v.text;
  }
  EXPECT_GT(result.quality.distance, 0.0);
}

TEST(LetterPlan, RestsHaveTheCuspSpeed) {
  Settings settings;
  settings.cusp_speed = 0.1, settings.evaluations = 50;
  const planner::PlanResult result = plan(four_cars(), {}, settings);
  for (const traj::RobotTrajectory& robot : result.plan.robots)
    for (const traj::Segment& segment : robot.segments)
      for (const double t : {0.0, segment.duration()}) {
        const traj::State state = traj::evaluate(segment, t);
        EXPECT_NEAR(state.speed, segment.gear * 0.1, 1e-9);
        EXPECT_NEAR(state.acceleration, 0.0, 1e-6);
        EXPECT_NEAR(state.curvature, 0.0, 1e-6);
      }
}

TEST(LetterPlan, GoesToTheTargetOnlyWithTheCatchTerm) {
  const world::Scenario scenario = world::throw_scene(3, 2);
  const Settings settings{.evaluations = 250};
  const planner::PlanResult with = plan(scenario, {}, settings);
  const planner::PlanResult without = plan(scenario, {.without = {.catching = true}}, settings);
  ASSERT_EQ(with.certificate.catches.size(), 1U);
  ASSERT_EQ(without.certificate.catches.size(), 1U);
  EXPECT_GT(with.certificate.catches.front().rim_margin, 0.0);
  EXPECT_LT(without.certificate.catches.front().rim_margin, 0.0);
}

TEST(LetterPlan, WithoutRelaxationTheTeamEndsWhereTheGuessDoes) {
  const world::Scenario scenario = world::throw_scene(3, 1);
  const planner::PlanResult fixed = plan(scenario, {.without = {.relaxation = true}}, {.evaluations = 50});
  for (std::size_t k = 0; k < 3; ++k) {
    const geom::Pose2 end = fixed.plan.robots[k].at(1e9).pose;
    const geom::Pose2 start = scenario.robots[k].start, first = scenario.robots[0].start;
    const geom::Pose2 of_first = fixed.plan.robots[0].at(1e9).pose;
    // The formation of the start, moved.
    EXPECT_NEAR(end.x - of_first.x, start.x - first.x, 1e-9);
    EXPECT_NEAR(end.y - of_first.y, start.y - first.y, 1e-9);
    EXPECT_NEAR(end.heading, start.heading, 1e-9);
  }
}

TEST(LetterPlan, IsTheSameForAnyNumberOfThreads) {
  const world::Scenario scenario = four_cars();
  const Settings settings{.evaluations = 100};
  const planner::PlanResult one = plan(scenario, {.threads = 1}, settings);
  const planner::PlanResult two = plan(scenario, {.threads = 2}, settings);
  EXPECT_EQ(one.iterations, two.iterations);
  for (std::size_t k = 0; k < one.plan.robots.size(); ++k)
    EXPECT_EQ(one.plan.robots[k].arrival(), two.plan.robots[k].arrival());
}

TEST(LetterPlan, KeepsTheDeadline) {
  const planner::PlanResult result = plan(world::generate(world::Family::random, 8, 1), {.deadline_s = 1e-4});
  EXPECT_FALSE(*result.claimed);
  EXPECT_FALSE(result.certified);
}

TEST(LetterPlan, ACarAtItsGoalStays) {
  world::Scenario parked = four_cars();
  parked.robots[0].goal = parked.robots[0].start;
  const planner::PlanResult result = plan(parked);
  ASSERT_EQ(result.plan.robots.size(), 4u);
  EXPECT_TRUE(result.plan.robots[0].stands);
  EXPECT_EQ(result.plan.robots[0].arrival(), 0.0);
}

TEST(LetterPlan, RefusesWhatTheMethodDoesNotKnow) {
  world::Scenario moving = four_cars();
  moving.obstacles.push_back({.name = "cart",
                              .shape = world::Circle{{0.0, 0.0}, 0.1},
                              .motion = {{0.0, {-50.0, -50.0, 0.0}}, {9.0, {-50.0, -40.0, 0.0}}}});
  EXPECT_THROW(plan(moving), InputError);
  Settings still;
  still.cusp_speed = 0.0;
  EXPECT_THROW(plan(four_cars(), {}, still), InputError);
  const traj::TeamTrajectory earlier;
  EXPECT_THROW(plan(four_cars(), {.previous = &earlier}), InputError);
}

}  // namespace
}  // namespace seine::baseline::letter
