// A car that starts inside the margin: what Margins::leaving grants, and what it does not.
#include <gtest/gtest.h>

#include "seine/certify/certificate.hpp"
#include "seine/certify/test/plans.hpp"
#include "seine/world/static_map.hpp"

namespace seine::certify::test {
namespace {

using Boxes = std::vector<geom::Box>;

// The car, 0.6 × 0.4 m from x = −0.1, drives 3 m straight on; a post stands 3 cm behind it.
struct Departure {
  traj::TeamTrajectory plan{{straight({0.0, 0.0, 0.0}, 3.0, 4.0)}};
  world::Scenario scenario = scenario_for(plan, car(), 20.0);

  explicit Departure(const Boxes& more = {}) {
    scenario.margins = {.robot = 0.05, .obstacle = 0.05, .leaving = 0.02};
    Boxes all{{{-1.0, -0.5}, {-0.13, 0.5}}};
    all.insert(all.end(), more.begin(), more.end());
    for (const geom::Box& b : all)
      scenario.obstacles.push_back(
          {.name = "box",
           .shape = std::vector<Vec2>{b.low, {b.high.x, b.low.y}, b.high, {b.low.x, b.high.y}},
           .motion = {}});
  }
  Certificate judged() const { return certify(scenario, world::StaticMap(scenario), plan); }
};

TEST(Leaving, GrantsTheSmallerClearanceUntilTheMarginIsReached) {
  Departure free;
  EXPECT_TRUE(free.judged().holds);
  free.scenario.margins.leaving.reset();
  EXPECT_FALSE(free.judged().holds);
  free.scenario.margins.leaving = 0.0305;
  const Certificate tight = free.judged();
  ASSERT_FALSE(tight.holds);
  EXPECT_EQ(tight.violations.front().kind, Kind::obstacle_clearance);
  EXPECT_EQ(tight.violations.front().limit, 0.0305);
}

TEST(Leaving, AsksForTheWholeMarginAfterwards) {
  for (const double gap : {0.03, 0.0495}) {
    const Departure past(Boxes{{{1.0, 0.2 + gap}, {2.0, 1.0}}});
    const Certificate certificate = past.judged();
    ASSERT_FALSE(certificate.holds) << gap;
    EXPECT_EQ(certificate.violations.front().limit, 0.05);
    EXPECT_NEAR(certificate.violations.front().value, gap, 1e-3);
  }
  EXPECT_TRUE(Departure(Boxes{{{1.0, 0.2501}, {2.0, 1.0}}}).judged().holds);
}

TEST(Leaving, AsksForTheWholeMarginAtTheGoal) {
  EXPECT_FALSE(Departure(Boxes{{{3.53, -0.5}, {4.0, 0.5}}}).judged().holds);
}

TEST(Leaving, OfACarThatNeverGetsOutIsNone) {
  EXPECT_FALSE(Departure(Boxes{{{-1.0, 0.23}, {5.0, 1.0}}}).judged().holds);
}

TEST(Leaving, CountsTheBoundsAndNotOtherCars) {
  Departure free;
  free.scenario.obstacles.clear();
  free.scenario.bounds.low.x = -0.13;
  EXPECT_TRUE(free.judged().holds);
  free.plan.robots.push_back(parked({0.0, 0.43, 0.0}));
  world::Scenario two = scenario_for(free.plan, car(), 20.0);
  two.margins = free.scenario.margins;
  EXPECT_FALSE(certify(two, world::StaticMap(two), free.plan).holds);
}

}  // namespace
}  // namespace seine::certify::test
