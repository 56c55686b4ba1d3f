// The planner's plans, the trackers and the simulation together.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "seine/drive/replanner.hpp"
#include "seine/drive/tracking.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::drive {
namespace {

constexpr std::uint64_t kSeed = 5;

struct Task {
  world::Scenario scenario;
  planner::PlanResult planned;
};

Task planned(world::Scenario scenario) {
  planner::PlanResult result = planner::plan(scenario, {.threads = 1});
  EXPECT_TRUE(result.certified) << result.reason;
  return {std::move(scenario), std::move(result)};
}

const Task& a_throw() {
  static const Task task = planned(world::throw_scene(4, 1));
  return task;
}

sim::SimulationResult run(const Task& task, sim::SimulationOptions options) {
  const sim::Controller controller = tracking_controller(task.scenario, tracking_options(options.noise));
  return sim::simulate(task.scenario, task.planned.plan, controller, options);
}

TEST(Drive, TeamsFollowTheirPlansAtEveryNoise) {
  const Task task = planned(world::generate(world::Family::random, 8, 3));
  for (const auto& [name, most] :
       {std::pair{"none", 0.01}, std::pair{"low", 0.03}, std::pair{"high", 0.08}}) {
    const sim::SimulationResult result = run(task, {.noise = sim::noise_named(name), .seed = kSeed});
    std::printf("random, 8 cars, noise %s: %.4f m rms, %.4f m at worst\n", name, result.tracking_rms,
                result.tracking_worst);
    EXPECT_LT(result.tracking_rms, most) << name;
    EXPECT_TRUE(result.delivered) << name;
    EXPECT_FALSE(result.stopped);
  }
}

TEST(Drive, CatchesAndDeliversWhatIsThrown) {
  for (const char* noise : {"none", "low"}) {
    const sim::SimulationResult result =
        run(a_throw(), {.noise = sim::noise_named(noise), .seed = kSeed, .replanner = replanner()});
    EXPECT_TRUE(result.caught && result.delivered) << noise;
    EXPECT_LT(result.worst_stretch, 1.0);
    EXPECT_GT(result.replans_asked, 2);
  }
}

TEST(Drive, SameSeedSameBits) {
  const sim::SimulationOptions options{.noise = sim::noise_named("high"), .seed = kSeed};
  const sim::SimulationResult a = run(a_throw(), options), b = run(a_throw(), options);
  EXPECT_EQ(a.tracking_rms, b.tracking_rms);
  EXPECT_EQ(a.outcomes.at(0).lowest, b.outcomes.at(0).lowest);
}

TEST(Drive, AFailedSolveIsBridgedByTheLastPlanOfTheTracker) {
  sim::SimulationOptions options{.noise = sim::noise_named("low"), .seed = kSeed};
  options.faults.failed_controls = {{1, 0.8, 0.05}};
  const sim::SimulationResult result = run(a_throw(), options);
  EXPECT_FALSE(result.stopped);
  EXPECT_LT(result.tracking_rms, 0.03);
}

TEST(Drive, SolvesThatGoOnFailingStopTheTeam) {
  sim::SimulationOptions options{.noise = sim::noise_named("low"), .seed = kSeed};
  options.faults.failed_controls = {{1, 0.8, 9.0}};
  const sim::SimulationResult result = run(a_throw(), options);
  EXPECT_TRUE(result.stopped);
  EXPECT_FALSE(result.delivered);
  EXPECT_LT(result.worst_stretch, 1.0);
  EXPECT_GT(result.min_clearance, 0.0);
}

// A stop slows the common clock: the team passes only through formations that the certificate has seen, so
// that what the certificate promises of them holds on the way to a stand.
void expect_certified_stop(const Task& task, double blind_from) {
  sim::SimulationOptions options;
  options.faults.lost_fixes = {
      {0, blind_from, 99.0}};  // the others stop for a car that is blind for a second
  const sim::SimulationResult planned = run(task, {}), stopped = run(task, options);
  ASSERT_TRUE(stopped.stopped);
  EXPECT_LT(stopped.tracking_worst, 0.1) << "along its own way, the blind one by its wheels";
  EXPECT_GE(stopped.min_clearance, planned.min_clearance - 0.01);
  EXPECT_LE(stopped.worst_stretch, planned.worst_stretch + 0.01);
  EXPECT_GE(stopped.min_clearance, task.scenario.margins.robot - 0.01);
  if (task.scenario.net) {
    EXPECT_LE(stopped.worst_stretch, task.scenario.net->stretch + 0.005);
  }
}

TEST(Drive, AStopKeepsWhatTheCertificatePromises) {
  const Task many = planned(world::generate(world::Family::random, 8, 4));
  for (const double from : {0.2, 1.1, 2.4}) {
    expect_certified_stop(a_throw(), from);
    expect_certified_stop(many, from);
  }
}

TEST(Drive, ANewPlanStartsWhereTheOldOneIsAndIsCertified) {
  const Task& task = a_throw();
  sim::Situation situation{task.scenario, task.planned.plan, 0.3, 5.0};
  for (std::size_t k = 0; k < task.scenario.robots.size(); ++k) {
    const traj::State state = task.planned.plan.robots[k].at(0.3);
    situation.scenario.robots[k].start = state.pose;
    situation.scenario.robots[k].start_speed = state.speed;
  }
  net::Target& target = situation.scenario.targets.at(0);
  target.time -= 0.3;
  target.position.x += 0.05;
  const sim::Replanned answer = replanner()(situation);
  ASSERT_TRUE(answer.certified);
  EXPECT_GT(answer.seconds, 0.0);
  for (std::size_t k = 0; k < task.scenario.robots.size(); ++k) {
    const traj::State now = answer.plan.robots[k].at(0.0), then = task.planned.plan.robots[k].at(0.3);
    EXPECT_LT(geom::norm(now.pose.position() - then.pose.position()), 1e-6);
    EXPECT_NEAR(now.speed, then.speed, 1e-6);
  }
}

TEST(Drive, ATaskThatNobodyCouldPlanIsNoNewPlan) {
  const Task& task = a_throw();
  sim::Situation situation{task.scenario, task.planned.plan, 0.3, 5.0};
  situation.scenario.robots[1].start = situation.scenario.robots[0].start;
  EXPECT_FALSE(replanner()(situation).certified);
}

}  // namespace
}  // namespace seine::drive
