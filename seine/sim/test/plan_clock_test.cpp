// Stopping by the clock: the same ways, slower, within the cars' limits.
#include "seine/sim/plan_clock.hpp"

#include <gtest/gtest.h>

#include "seine/sim/stopping.hpp"
#include "seine/sim/test/drives.hpp"

namespace seine::sim {
namespace {

TEST(PlanClock, RunsEvenlyUntilToldOtherwise) {
  PlanClock clock(2.0);
  clock.advance(0.5);
  EXPECT_DOUBLE_EQ(clock.time(), 2.5);
  clock.accelerate(-2.0);
  EXPECT_DOUBLE_EQ(clock.ahead(0.25).time(), 2.5 + 0.25 - 0.0625);
  EXPECT_DOUBLE_EQ(clock.ahead(0.25).rate(), 0.5);
  EXPECT_DOUBLE_EQ(clock.ahead(9.0).time(), 2.75) << "it never runs backwards";
  EXPECT_TRUE(clock.ahead(9.0).stands());
  for (int i = 0; i < 900; ++i) clock.advance(0.01);
  EXPECT_NEAR(clock.time(), 2.75, 1e-12) << "in small steps as in one";
}

TEST(PlanClock, SlowedStatesAreDerivativesOfEachOther) {
  const Drive drive = drive_of(3);
  PlanClock clock(1.3);
  clock.accelerate(-0.8);
  clock.advance(0.2);
  constexpr double h = 1e-5;
  const traj::RobotTrajectory& way = drive.plan.robots[1];
  const traj::State now = clock.state_on(way), soon = clock.ahead(h).state_on(way);
  EXPECT_NEAR(geom::norm(soon.pose.position() - now.pose.position()) / h, now.speed, 1e-4);
  EXPECT_NEAR((soon.speed - now.speed) / h, now.acceleration, 1e-2);
  EXPECT_NEAR((soon.curvature - now.curvature) / h, now.curvature_rate, 1e-2);
}

TEST(Stopping, IsAsHardAsTheLimitsAllowAndNoHarder) {
  const Drive drive = drive_of(4, 6.0, 5.0, 0.8);
  for (const double start : {0.6, 1.5, 2.5, 3.5, 4.4}) {
    PlanClock clock(start);
    double hardest = 0.0;
    int ticks = 0;
    while (!clock.stands() && ticks < 3000) {
      clock.accelerate(stopping_change(drive.scenario, drive.plan, clock, std::nullopt, {}));
      for (const auto& way : drive.plan.robots) {
        const traj::State state = clock.state_on(way);
        if (std::abs(state.speed) > 0.1) hardest = std::max(hardest, std::abs(state.acceleration));
      }
      clock.advance(1e-3);
      ++ticks;
    }
    EXPECT_LE(hardest, 3.0 + 1e-6) << "from " << start;
    EXPECT_GE(hardest, 2.5);
    EXPECT_LT(ticks, 1000) << "from 2.3 m/s at 3 m/s² it takes 0.8 s";
  }
}

TEST(Stopping, FindsACarOnItsWay) {
  const Drive drive = drive_of(3);
  for (const double t : {0.8, 1.9, 3.1}) {
    const geom::Vec2 beside = drive.plan.robots[0].at(t).pose * geom::Vec2{0.0, 0.1};
    EXPECT_NEAR(progress_of(drive.plan.robots[0], beside, t + 0.2), t, 0.03);
  }
}

}  // namespace
}  // namespace seine::sim
