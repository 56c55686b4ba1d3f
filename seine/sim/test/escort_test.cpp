// Going with a car that no longer answers; waiting for one that falls behind.
#include "seine/sim/escort.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "seine/base/rng.hpp"
#include "seine/sim/pacing.hpp"
#include "seine/sim/test/drives.hpp"

namespace seine::sim {
namespace {

constexpr std::uint64_t kSeed = 20;

TEST(Escort, KeepsTheFormationOfThePlanWhateverTheSilentCarDoes) {
  const Drive drive = drive_of(4);
  Rng rng(kSeed);
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (int i = 0; i < 50; ++i) {
    PlanClock clock(rng.uniform(0.5, 4.0));
    clock.accelerate(-1.0);
    const traj::State planned = drive.plan.robots[0].at(clock.time());
    CarState silent{planned.pose, planned.speed, rng.uniform(-0.5, 0.5), 0.0};
    silent.pose.x += rng.uniform(-0.1, 0.1);
    const Escort escort(drive.scenario.models[0], silent, drive.plan.robots[0]);
    const double ahead = rng.uniform(0.0, 1.0), then = clock.ahead(ahead).time();
    const geom::Vec2 one = escort.state_on(drive.plan.robots[1], clock, ahead).pose.position();
    const geom::Vec2 two = escort.state_on(drive.plan.robots[2], clock, ahead).pose.position();
    const geom::Vec2 itself = escort.state_on(drive.plan.robots[0], clock, ahead).pose.position();
    const auto as_planned = [&](std::size_t k) { return drive.plan.robots[k].at(then).pose.position(); };
    EXPECT_NEAR(geom::norm(one - two), geom::norm(as_planned(1) - as_planned(2)), 1e-9);
    EXPECT_NEAR(geom::norm(one - itself), geom::norm(as_planned(1) - as_planned(0)), 1e-9);
  }
}

TEST(Pacing, WhatIsBehindIsMeasuredAlongTheDirectionOfTravel) {
  traj::State forwards{.pose = {1.0, 2.0, 0.0}, .speed = 1.0}, backwards = forwards;
  backwards.speed = -1.0;
  EXPECT_NEAR(lag_behind({0.9, 2.3, 0.4}, forwards), 0.1, 1e-12);
  EXPECT_NEAR(lag_behind({0.9, 2.3, 0.4}, backwards), -0.1, 1e-12);
}

TEST(PlanClock, SlowsToThePaceThatIsWantedAndNoFurther) {
  PlanClock clock(1.0);
  clock.accelerate(-1.0, 0.8);
  EXPECT_DOUBLE_EQ(clock.ahead(5.0).rate(), 0.8);
  clock.advance(1.0);
  EXPECT_NEAR(clock.time(), 1.0 + 0.18 + 0.8 * 0.8, 1e-12);
  clock.accelerate(0.5, 1.0);
  EXPECT_DOUBLE_EQ(clock.ahead(5.0).rate(), 1.0);
}

}  // namespace
}  // namespace seine::sim
