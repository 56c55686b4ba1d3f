// Planted collisions: short ones, late ones, and things one forgets to look at.
#include <gtest/gtest.h>

#include "seine/certify/test/brute_force.hpp"

namespace seine::certify::test {
namespace {

Certificate judge(const world::Scenario& scenario, const traj::TeamTrajectory& plan) {
  return certify(scenario, world::StaticMap(scenario), plan);
}

void expect_only(const Certificate& certificate, Kind kind) {
  EXPECT_FALSE(certificate.holds);
  EXPECT_TRUE(breaks(certificate, kind)) << summary(certificate);
  for (const Violation& v : certificate.violations) EXPECT_EQ(v.kind, kind) << summary(certificate);
}

traj::RobotTrajectory after(double wait, traj::RobotTrajectory way) {
  way.segments.front().wait = wait;
  return way;
}

TEST(PlantedClearance, OneMillimetreForLessThanAMillisecond) {
  // Two fast cars cross; the second comes so late that only corners meet.
  const auto crossing = [](double wait) {
    return traj::TeamTrajectory{{straight({-10.0, 0.0, 0.0}, 20.0, 2.0),
                                 after(wait, straight({0.1, -10.0, 0.5 * std::numbers::pi}, 20.0, 2.0))}};
  };
  world::Scenario scenario = scenario_for(crossing(0.0), car(), 100.0);
  const world::StaticMap map(scenario);
  const auto deepest = [&](double wait) {
    return least_distances(scenario, map, crossing(wait), 0.9, 1.2, 1e5).robots;
  };
  double low = 0.0, high = 0.5;  // overlaps at low, is clear at high
  ASSERT_LT(deepest(low), -0.05);
  ASSERT_GT(deepest(high), 0.05);
  while (high - low > 1e-7) {
    const double middle = 0.5 * (low + high);
    (deepest(middle) < -1e-3 ? low : high) = middle;
  }
  const auto plan = crossing(low);
  // How long the overlap lasts, and that some grid of 1 kHz sees nothing.
  int overlapping = 0;
  for (int i = 0; i < 30000; ++i)
    overlapping += distances_at(scenario, map, plan, 0.9 + i * 1e-5).robots < 0.0;
  EXPECT_GT(overlapping, 0);
  EXPECT_LT(overlapping, 100);
  const Certificate certificate = certify(scenario, map, plan);
  expect_only(certificate, Kind::robot_clearance);
  ASSERT_FALSE(certificate.holds);
  EXPECT_NEAR(certificate.violations.front().value, -1e-3, 1e-3);
  const auto clear = crossing(high + 2e-3);
  EXPECT_TRUE(certify(scenario, map, clear).holds) << summary(certify(scenario, map, clear));
}

TEST(PlantedClearance, ParkedInTheWayAfterArrival) {
  // The first arrives at t = 1 and stands there; the second comes by at t = 60.
  const traj::TeamTrajectory plan{
      {straight({-3.0, 0.0, 0.0}, 3.0, 1.0), after(58.0, straight({0.0, -5.0, 1.5}, 10.0, 4.0))}};
  const Certificate certificate = judge(scenario_for(plan, car(), 100.0), plan);
  expect_only(certificate, Kind::robot_clearance);
  ASSERT_FALSE(certificate.holds);
  EXPECT_NEAR(certificate.violations.front().time, 60.0, 0.5);
}

TEST(PlantedClearance, ParkedTooCloseForEver) {
  for (const double gap : {0.0490, 0.0510}) {
    const traj::TeamTrajectory plan{{parked({0, 0, 0}), parked({0, 0.4 + gap, 0})}};
    world::Scenario scenario = scenario_for(plan, car(), 10.0);
    scenario.margins.robot = 0.05;
    const Certificate certificate = judge(scenario, plan);
    EXPECT_EQ(certificate.holds, gap > 0.05) << summary(certificate);
    EXPECT_NEAR(certificate.robots.clearance, gap, 1e-9);
  }
}

TEST(PlantedClearance, AThinSpikeBetweenSamples) {
  // A needle whose tip reaches 1 mm into the side of the lane of a fast car.
  const traj::TeamTrajectory plan{{straight({-10.0, 0.0, 0.0}, 20.0, 2.0)}};
  world::Scenario scenario = scenario_for(plan, car(), 100.0);
  const auto needle = [&](double tip) {
    scenario.obstacles = {{.name = "needle",
                           .shape = std::vector<Vec2>{{1.0, tip}, {1.0005, 1.0}, {0.9995, 1.0}},
                           .motion = {}}};
  };
  needle(0.199);
  expect_only(judge(scenario, plan), Kind::obstacle_clearance);
  needle(0.201);
  EXPECT_TRUE(judge(scenario, plan).holds) << summary(judge(scenario, plan));
}

TEST(PlantedClearance, MovingObstacles) {
  const traj::TeamTrajectory plan{{straight({-3.0, 0.0, 0.0}, 3.0, 1.0)}};
  world::Scenario scenario = scenario_for(plan, car(), 100.0);
  const auto with = [&](world::Obstacle obstacle) {
    scenario.obstacles = {std::move(obstacle)};
    return judge(scenario, plan);
  };
  const std::vector<Vec2> bar{{-1.0, -0.05}, {1.0, -0.05}, {1.0, 0.05}, {-1.0, 0.05}};
  const world::Circle ball{{0.0, 0.0}, 0.1};
  // Passes through the parked car long after its arrival, within 3 ms.
  expect_only(
      with({.name = "ball", .shape = ball, .motion = {{50.0, {0.0, 50.0, 0.0}}, {50.1, {0.0, -50.0, 0.0}}}}),
      Kind::moving_obstacle_clearance);
  // Stands in the way from the beginning, until its first waypoint.
  expect_only(with({.name = "", .shape = ball, .motion = {{5.0, {-1.5, 0.0, 0.0}}, {6.0, {-1.5, 9.0, 0.0}}}}),
              Kind::moving_obstacle_clearance);
  // Comes to stand at the goal.
  expect_only(with({.name = "", .shape = ball, .motion = {{0.0, {0.0, 9.0, 0.0}}, {20.0, {0.0, 0.0, 0.0}}}}),
              Kind::moving_obstacle_clearance);
  // Turns into the car on the spot; without turning, or turning the other way, it does not touch.
  expect_only(with({.name = "", .shape = bar, .motion = {{10.0, {0.1, 0.8, 0.0}}, {11.0, {0.1, 0.8, 1.5}}}}),
              Kind::moving_obstacle_clearance);
  EXPECT_TRUE(
      with({.name = "", .shape = bar, .motion = {{10.0, {0.1, 0.8, 0.0}}, {11.0, {0.1, 0.8, 0.3}}}}).holds);
  EXPECT_TRUE(
      with({.name = "", .shape = ball, .motion = {{0.0, {0.0, 9.0, 0.0}}, {20.0, {0.0, 0.5, 0.0}}}}).holds);
}

TEST(PlantedClearance, OutOfBounds) {
  const traj::TeamTrajectory plan{{straight({-3.0, 0.0, 0.0}, 3.0, 1.0)}};
  world::Scenario scenario = scenario_for(plan, car(), 4.0);
  EXPECT_TRUE(judge(scenario, plan).holds);
  scenario.bounds.high.x = 0.499;  // the car's front stops at 0.5
  expect_only(judge(scenario, plan), Kind::bounds);
  scenario.bounds.high.x = 4.0;
  scenario.bounds.low.y = -0.199;
  expect_only(judge(scenario, plan), Kind::bounds);
}

TEST(PlantedClearance, WhollyInsideABlockedArea) {
  // The static map has only the rim of blocked areas; this car never comes near it.
  const traj::TeamTrajectory plan{{parked({5.0, 5.0, 0.3})}};
  world::Scenario scenario = scenario_for(plan, car(), 20.0);
  geom::OccupancyGrid grid{
      .width = 100, .height = 100, .resolution = 0.1, .origin = {0.0, 0.0, 0.0}, .occupied = {}};
  grid.occupied.assign(10000, 1);
  scenario.map = grid;
  expect_only(judge(scenario, plan), Kind::obstacle_clearance);
  for (auto& cell : scenario.map->occupied) cell = 0;
  EXPECT_TRUE(judge(scenario, plan).holds);
}

TEST(PlantedClearance, SeveralInstantsOfTheSameBreak) {
  Rng rng(41);
  const traj::TeamTrajectory bent{{random_way(rng, {{0, 0, 0}, 0.0}, {.curve_pieces = 8})}};
  world::Scenario scenario = scenario_for(bent, car(), 50.0);
  scenario.models[0].limits.lateral_acceleration = 1.5;
  Options options;
  options.violations_per_kind = 3;
  EXPECT_EQ(judge(scenario, bent).violations.size(), 1u);
  const Certificate certificate = certify(scenario, world::StaticMap(scenario), bent, options);
  EXPECT_GT(certificate.violations.size(), 1u) << summary(certificate);
  for (std::size_t i = 1; i < certificate.violations.size(); ++i) {
    EXPECT_LE(certificate.violations[i - 1].time, certificate.violations[i].time);
  }
}

TEST(PlantedClearance, NoTimeMeansNoProof) {
  const traj::TeamTrajectory plan{{straight({-3.0, 0.0, 0.0}, 3.0, 1.0)}};
  const world::Scenario scenario = scenario_for(plan, car(), 10.0);
  Options options;
  options.deadline = Deadline(0.0);
  const Certificate certificate = certify(scenario, world::StaticMap(scenario), plan, options);
  EXPECT_FALSE(certificate.holds);
  EXPECT_TRUE(breaks(certificate, Kind::undecided)) << summary(certificate);
}

}  // namespace
}  // namespace seine::certify::test
