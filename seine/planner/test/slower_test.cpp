#include "seine/planner/slower.hpp"

#include <gtest/gtest.h>

#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"

namespace seine::planner {
namespace {

constexpr std::uint64_t kSeeds = 4;

traj::TeamTrajectory faster(traj::TeamTrajectory plan, double factor) {
  for (traj::RobotTrajectory& car : plan.robots)
    for (traj::Segment& segment : car.segments) segment.wait /= factor, segment.piece_duration /= factor;
  return plan;
}

// Driven too fast by some share, a plan breaks its limits; slowed, it holds and takes hardly longer than
// before.
TEST(Slower, BringsBackWhatWasDrivenTooFast) {
  for (const int cars : {1, 6})
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
      for (const double factor : {1.02, 1.3, 2.5}) {
        SCOPED_TRACE(testing::Message() << cars << " cars, seed " << seed << ", " << factor << " times");
        const world::Scenario scenario = world::generate(world::Family::random, cars, seed);
        const world::StaticMap map(scenario);
        const PlanResult result = plan(scenario);
        ASSERT_TRUE(result.certified) << result.reason;
        const traj::TeamTrajectory hasty = faster(result.plan, factor);
        const certify::Certificate broken = certify::certify(scenario, map, hasty);
        if (broken.holds) continue;  // it had so much left
        const std::optional<double> needed = slowing(broken);
        ASSERT_TRUE(needed) << broken.violations.front().text;
        EXPECT_LE(*needed, factor * 1.01);
        const std::optional<Slowed> slower = certified_slower(scenario, map, broken, hasty, {});
        ASSERT_TRUE(slower);
        EXPECT_TRUE(slower->certificate.holds);
        EXPECT_LE(slower->plan.makespan(), result.plan.makespan() * 1.01);
      }
}

TEST(Slower, IsNoAnswerToACollision) {
  world::Scenario scenario = world::generate(world::Family::random, 1, 3);
  const PlanResult result = plan(scenario);
  ASSERT_TRUE(result.certified) << result.reason;
  const geom::Pose2 half_way = result.plan.robots[0].at(0.5 * result.plan.makespan()).pose;
  scenario.obstacles.push_back({.name = "post", .shape = world::Circle{half_way.position(), 0.1}});
  const world::StaticMap map(scenario);
  const traj::TeamTrajectory hasty = faster(result.plan, 1.3);
  const certify::Certificate broken = certify::certify(scenario, map, hasty);
  ASSERT_FALSE(broken.holds);
  EXPECT_FALSE(slowing(broken));
  EXPECT_FALSE(certified_slower(scenario, map, broken, hasty, {}));
}

TEST(Slower, LeavesASpeedAtTheStartAsItIsGiven) {
  world::Scenario scenario = world::generate(world::Family::random, 1, 3);
  const PlanResult result = plan(scenario);
  ASSERT_TRUE(result.certified) << result.reason;
  scenario.robots[0].start_speed = 0.5;
  const world::StaticMap map(scenario);
  certify::Certificate broken;
  broken.violations = {{.kind = certify::Kind::speed, .time = 0.1, .robot = 0, .value = 2.6, .limit = 2.5}};
  for (const Clock clock : {Clock::own, Clock::common})
    EXPECT_FALSE(slowed(scenario, broken, result.plan, clock));
  scenario.robots[0].start_speed = 0.0;
  for (const Clock clock : {Clock::own, Clock::common})
    EXPECT_TRUE(slowed(scenario, broken, result.plan, clock));
}

}  // namespace
}  // namespace seine::planner
