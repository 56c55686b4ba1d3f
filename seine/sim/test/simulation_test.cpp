// The closed loop as a whole: what a team does when all is well, and when it is not.
#include "seine/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "seine/sim/test/drives.hpp"
#include "seine/sim/test/teams.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 71;

SimulationResult run(const Drive& drive, SimulationOptions options = {}) {
  return simulate(drive.scenario, drive.plan, plain_tracker(drive.scenario), options);
}

bool says(const SimulationResult& result, const std::string& words) {
  for (const Note& note : result.notes)
    if (note.text.find(words) != std::string::npos) return true;
  return false;
}

Drive catching(int robots) {
  Drive drive = drive_of(robots);
  drive.scenario.targets = {throw_at(drive, 2.0, {1.5, 0.4, -4.5})};
  return drive;
}

TEST(Simulation, AnIdealTeamCatchesAndDelivers) {
  for (const int robots : teams()) {
    const SimulationResult result = run(catching(robots));
    EXPECT_TRUE(result.caught) << robots << ": " << name_of(result.outcomes.at(0).fate);
    EXPECT_TRUE(result.delivered);
    EXPECT_LT(result.tracking_rms, 0.01);
    EXPECT_LT(result.worst_stretch, 0.95);
    EXPECT_NEAR(result.outcomes[0].crossing_time, 2.0, 2e-3);
    EXPECT_EQ(result.goal_error, 0.0);
    EXPECT_TRUE(says(result, "lies in the net"));
    std::printf("%d cars: %.0f times real time, tracking %.1f mm\n", robots, result.real_time_factor,
                1e3 * result.tracking_rms);
  }
}

TEST(Simulation, NoiseIsBorne) {
  for (const auto& [name, limit] : {std::pair{"low", 0.03}, std::pair{"high", 0.08}}) {
    if (effort(1, 0) == 0 && limit < 0.05) continue;
    SimulationOptions options{.noise = noise_named(name), .seed = kSeed};
    const SimulationResult result = run(catching(4), options);
    EXPECT_TRUE(result.caught) << name;
    EXPECT_TRUE(result.delivered) << name << ", off by " << result.goal_error;
    EXPECT_LT(result.tracking_rms, limit) << name;
  }
}

TEST(Simulation, SameSeedSameBits) {
  SimulationOptions options{.noise = noise_named("high"), .seed = kSeed};
  Drive drive = drive_of(3, 1.0, 1.5, 0.1);
  drive.scenario.targets = {throw_at(drive, 0.9, {0.5, 0.0, -4.0})};
  const SimulationResult a = run(drive, options), b = run(drive, options);
  EXPECT_EQ(a.tracking_rms, b.tracking_rms);
  EXPECT_EQ(a.outcomes[0].lowest, b.outcomes[0].lowest);
  EXPECT_EQ(a.outcomes[0].catch_time, b.outcomes[0].catch_time);
  if (effort(1, 0) == 0) return;
  options.seed = kSeed + 1;
  EXPECT_NE(run(drive, options).tracking_rms, a.tracking_rms);
}

TEST(Simulation, WhatFallsBesideTheNetIsNotCaught) {
  Drive drive = drive_of(4);
  drive.scenario.targets = {throw_at(drive, 2.0, {0.5, 0.0, -4.5}, {0.0, 1.5})};
  const SimulationResult result = run(drive);
  EXPECT_FALSE(result.caught);
  EXPECT_FALSE(result.delivered);
  EXPECT_EQ(result.outcomes[0].fate, Fate::miss);
  EXPECT_TRUE(says(result, "missed the net"));
}

TEST(Simulation, CarriesAPayload) {
  Drive drive = drive_of(teams().back() == 3 ? 3 : 4, 2.0, 2.5, 0.2);
  drive.scenario.payload = net::Payload{};
  const SimulationResult result = run(drive);
  EXPECT_EQ(result.outcomes.size(), 1u);
  EXPECT_TRUE(result.delivered);
}

TEST(Simulation, APayloadHangsInNetsOfEverySize) {
  for (const int robots : {4, 6})
    for (const double size : {1.0, 1.6}) {
      Drive drive = drive_of(robots, 1.0, 2.0, 0.0);
      net::Net& net = *drive.scenario.net;
      for (geom::Vec2& corner : net.rest) corner *= size;
      for (net::Attachment& attachment : net.attachments) attachment.height *= size;
      for (std::size_t k = 0; k < drive.plan.robots.size(); ++k) {
        const geom::Vec2 corner = 0.86 * net.rest[k] - geom::Vec2{0.2, 0.0};
        drive.plan.robots[k] = traj::RobotTrajectory::standing({corner.x, corner.y, 0.0});
        drive.scenario.robots[k].start = {corner.x, corner.y, 0.0};
      }
      drive.scenario.delivery = net::Delivery{{}, 0.3, std::nullopt};
      drive.scenario.payload = net::Payload{};
      const SimulationResult result = run(drive);
      EXPECT_TRUE(result.delivered) << robots << " corners, " << size << " times as large";
    }
}

TEST(Simulation, TwoObjectsInOnePlaceAtOneTimeLieInOneNet) {
  for (const double apart : {0.0, 0.03}) {
    Drive drive = drive_of(4);
    drive.scenario.targets = {throw_at(drive, 2.0, {1.5, 0.0, -4.0}),
                              throw_at(drive, 2.0, {1.5, 0.0, -4.0}, {0.0, apart})};
    const SimulationResult result = run(drive);
    EXPECT_TRUE(result.delivered) << apart;
  }
}

TEST(Simulation, CatchesWhatFallsForLong) {
  Drive drive = drive_of(4, 1.0, 2.0, 0.0);
  net::Target target;
  target.position = {1.0, 0.0, 12.0};
  target.drag = 60.0;  // 0.4 m/s
  drive.scenario.targets = {target};
  EXPECT_TRUE(run(drive).caught);
}

TEST(Simulation, TwoTargetsInOneNet) {
  Drive drive = drive_of(4);
  drive.scenario.targets = {throw_at(drive, 1.5, {1.0, 0.4, -4.5}), throw_at(drive, 2.5, {1.0, -0.2, -5.0})};
  const SimulationResult result = run(drive);
  EXPECT_TRUE(result.delivered) << name_of(result.outcomes[0].fate) << ", "
                                << name_of(result.outcomes[1].fate);
}

TEST(Simulation, TeamsWithoutANetDriveToTheirGoals) {
  Drive drive = drive_of(4);
  drive.scenario.net.reset();
  drive.scenario.delivery.reset();
  for (std::size_t k = 0; k < 4; ++k) drive.scenario.robots[k].goal = drive.plan.robots[k].at(1e9).pose;
  const SimulationResult result = run(drive);
  EXPECT_TRUE(result.delivered);
  EXPECT_GT(result.min_clearance, 0.3);
  drive.scenario.robots[2].goal->x += 1.0;
  EXPECT_FALSE(run(drive).delivered);
}

TEST(Simulation, SeesCollisions) {
  Drive drive = drive_of(4);
  drive.scenario.obstacles.push_back(
      {.name = "pole", .shape = world::Circle{way(drive, 2.5) + geom::Vec2{1.3, 0.0}, 0.1}});
  EXPECT_LT(run(drive).min_clearance, 0.0);
}

// ----- faults: the team goes on, or it stops with its net whole, and says so

void expect_stopped_safely(const SimulationResult& result, const std::string& why) {
  EXPECT_TRUE(result.stopped);
  EXPECT_TRUE(says(result, why) && says(result, "the team stops"));
  EXPECT_LT(result.worst_stretch, 0.97) << "of 1 the net would tear";
  EXPECT_GT(result.min_clearance, 0.05);
  EXPECT_FALSE(result.delivered);
}

TEST(Faults, HalfASecondWithoutFixesIsNothing) {
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.faults.lost_fixes = {{1, 1.4, 0.5}};
  const SimulationResult result = run(catching(4), options);
  EXPECT_TRUE(result.caught && result.delivered);
  EXPECT_FALSE(result.stopped);
  EXPECT_LT(result.tracking_worst, 0.1);
}

TEST(Faults, ACarThatStaysBlindStopsTheTeam) {
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.faults.lost_fixes = {{1, 0.5, 9.0}};
  expect_stopped_safely(run(catching(4), options), "car1 does not know where it is");
}

TEST(Faults, OneFailedStepOfAControllerIsBridged) {
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.faults.failed_controls = {{2, 1.8, 0.05}};
  const SimulationResult result = run(catching(4), options);
  EXPECT_TRUE(result.caught && result.delivered);
  EXPECT_FALSE(result.stopped);
}

TEST(Faults, AControllerThatFailsForGoodStopsTheTeam) {
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.faults.failed_controls = {{2, 1.0, 9.0}};
  EXPECT_TRUE(says(run(catching(4), options), "car2 has no controller"));
}

TEST(Faults, ABrokenCarStopsTheTeamWithItsNetWhole) {
  constexpr std::array kTimes{1.0, 2.0, 3.2, 2.4};
  for (std::size_t broken = 0; broken < static_cast<std::size_t>(effort(4, 1)); ++broken) {
    SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
    options.faults.breakdowns = {{broken, kTimes[broken]}};
    expect_stopped_safely(run(catching(4), options), "car" + std::to_string(broken) + " does not answer");
  }
}

// A replanner that bends the plan towards where the first target will fall; says it is certified.
Replanned bend_towards(const Drive& drive, const Situation& situation) {
  const net::Target& target = situation.scenario.targets.at(0);
  const auto crossing = net::Flight(target).crossing(1.0);
  if (!crossing) return {};
  const double then = crossing->state.time, now = situation.plan_time;
  geom::Vec2 middle;
  for (std::size_t k = 0; k < 4; ++k)
    middle += 0.25 * (situation.plan.robots[k].at(now + then).pose * drive.scenario.net->attachments[k].at);
  const geom::Vec2 off = crossing->state.position.ground() - middle;
  const double left = situation.plan.makespan() - now;
  Replanned answer{.certified = true};
  for (std::size_t k = 0; k < 4; ++k) {
    answer.plan.robots.push_back(follow(
        [&](double t) {
          const geom::Vec2 as_planned = situation.plan.robots[k].at(now + t).pose.position();
          return as_planned + smooth(t / std::min(then, left)) * off;
        },
        left));
  }
  return answer;
}

TEST(Replanning, FollowsTheTargetWhereItReallyFlies) {
  constexpr int kSeeds = effort(4, 1);
  int without = 0, with = 0;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(kSeeds); ++seed) {
    Drive drive = catching(4);
    drive.scenario.delivery->radius = 1.5;
    drive.scenario.targets[0] = throw_at(drive, 2.4, {1.2, 0.2, -4.5});
    for (std::size_t i = 3; i < 6; ++i) drive.scenario.targets[0].covariance[i][i] = 1.0;
    SimulationOptions options{.noise = noise_named("low"), .seed = seed};
    without += run(drive, options).caught ? 1 : 0;
    options.replanner = [&](const Situation& situation) { return bend_towards(drive, situation); };
    const SimulationResult result = run(drive, options);
    with += result.caught ? 1 : 0;
    EXPECT_GT(result.replans_asked, 3);
    EXPECT_GE(result.replans, 1);
  }
  std::printf("caught %d of %d without replanning, %d with\n", without, kSeeds, with);
  if (kSeeds > 1) {
    EXPECT_LT(without, kSeeds);
  }
  EXPECT_EQ(with, kSeeds);
}

TEST(Replanning, WhatIsNotCertifiedOrNotBetterIsNotUsed) {
  const Drive drive = catching(4);
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.replanner = [&](const Situation& situation) {
    Replanned answer = bend_towards(drive, situation);
    answer.certified = false;
    return answer;
  };
  EXPECT_EQ(run(drive, options).replans, 0);
  options.replanner = [&](const Situation& situation) {
    Replanned answer{.certified = true};
    for (const auto& robot : situation.plan.robots)  // the same again, later and elsewhere
      answer.plan.robots.push_back(follow(
          [&](double t) {
            return robot.at(situation.plan_time + t).pose.position() + smooth(t) * geom::Vec2{0.0, 0.8};
          },
          4.0));
    return answer;
  };
  const SimulationResult result = run(drive, options);
  EXPECT_EQ(result.replans, 0);
  EXPECT_TRUE(result.caught);
}

TEST(Faults, APlanThatComesTooLateIsNotUsed) {
  const Drive drive = catching(4);
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.replanner = [&](const Situation& situation) { return bend_towards(drive, situation); };
  options.faults.late_replans = {{0.0, 9.0}};
  const SimulationResult result = run(drive, options);
  EXPECT_EQ(result.replans, 0);
  EXPECT_EQ(result.replans_late, result.replans_asked);
  EXPECT_TRUE(says(result, "too late"));
  EXPECT_TRUE(result.caught && result.delivered) << "by the plan it had";
}

TEST(Faults, AJumpOfWhatIsSeenIsNotBelievedAtOnce) {
  Drive drive = catching(4);
  drive.scenario.delivery->radius = 1.0;
  SimulationOptions options{.noise = noise_named("low"), .seed = kSeed};
  options.replanner = [&](const Situation& situation) { return bend_towards(drive, situation); };
  options.faults.target_jumps = {{0, 1.5, 0.03, {0.8, -0.8, 0.0}}};
  SimulationResult result = run(drive, options);
  EXPECT_TRUE(result.caught && result.delivered);
  // One that lasts is followed, and undone when the target is seen again where it is.
  options.faults.target_jumps = {{0, 1.4, 0.15, {0.6, -0.6, 0.0}}};
  result = run(drive, options);
  EXPECT_TRUE(result.caught && result.delivered) << name_of(result.outcomes[0].fate);
}

}  // namespace
}  // namespace seine::sim
