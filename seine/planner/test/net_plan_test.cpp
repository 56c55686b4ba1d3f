#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/planner/net_question.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;

std::vector<Vec2> ring_at(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double t) {
  std::vector<Vec2> ring;
  for (std::size_t k = 0; k < plan.robots.size(); ++k)
    ring.push_back(plan.robots[k].at(t).pose * scenario.net->attachments[k].at);
  return ring;
}

// Looks at a certified plan with eyes of its own: at 200 Hz, and at the catch.
void expect_carried(const world::Scenario& scenario, const traj::TeamTrajectory& plan) {
  const net::Net& net = *scenario.net;
  for (double t = 0.0; t < plan.makespan() + 0.1; t += 0.005) {
    const std::vector<Vec2> ring = ring_at(scenario, plan, t);
    for (std::size_t i = 0; i < ring.size(); ++i)
      for (std::size_t j = i + 1; j < ring.size(); ++j)
        ASSERT_LE(geom::norm(ring[i] - ring[j]), net.stretch * net::rest_distance(net, i, j) + 1e-3) << t;
    ASSERT_GT(net::opening(net, ring), 0.2) << t;
  }
  if (scenario.delivery) {
    Vec2 middle;
    for (const Vec2 a : ring_at(scenario, plan, plan.makespan() + 1.0))
      middle += a / static_cast<double>(net.size());
    EXPECT_LE(geom::norm(middle - scenario.delivery->center), scenario.delivery->radius + 1e-3);
  }
  for (const net::Target& target : scenario.targets) {
    const auto crossing = net::Flight(target).crossing(net.rim());
    ASSERT_TRUE(crossing.has_value());
    const double t = crossing->state.time;
    const auto before = ring_at(scenario, plan, t - 1e-3), now = ring_at(scenario, plan, t),
               after = ring_at(scenario, plan, t + 1e-3);
    net::Motion motion;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double share = 1.0 / static_cast<double>(before.size());
      motion.velocity += (share / 2e-3) * (after[k] - before[k]);
      motion.acceleration += (share / 1e-6) * (after[k] - 2.0 * now[k] + before[k]);
    }
    const net::Catch c = net::measure_catch(net, target, *crossing, now, motion);
    EXPECT_GE(c.rim_margin, net::kRimMargin - 1e-3);
    EXPECT_GE(c.contact_margin, net::kContactMargin - 1e-3);
    EXPECT_GE(c.opening, net::kLeastOpening - 1e-3);
    EXPECT_LE(c.speed, net::speed_limit(c.depth, target.radius, net.rebound) + 1e-2);
    EXPECT_GE(c.bottom, net.clearance - 1e-3);
  }
}

TEST(NetPlan, ThrowsAreCaughtAndDelivered) {
  int certified = 0;
  for (const int robots : {3, 4, 6})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const world::Scenario scenario = world::throw_scene(robots, seed);
      const PlanResult result = plan(scenario, {.threads = 1});
      certified += result.certified;
      if (result.certified) expect_carried(scenario, result.plan);
    }
  EXPECT_GE(certified, 11) << "of 12";
}

TEST(NetPlan, LoadsAreCarriedThroughGaps) {
  for (const int robots : {3, 4}) {
    const world::Scenario scenario = world::gap_scene(robots, 1, 2.2);
    const PlanResult result = plan(scenario, {.threads = 1});
    ASSERT_TRUE(result.certified) << result.reason;
    expect_carried(scenario, result.plan);
  }
}

TEST(NetPlan, IsTheSameForAnyNumberOfThreads) {
  const world::Scenario scenario = world::throw_scene(4, 2);
  const PlanResult one = plan(scenario, {.threads = 1}), three = plan(scenario, {.threads = 3});
  ASSERT_TRUE(one.certified) << one.reason;
  ASSERT_EQ(one.plan.robots.size(), three.plan.robots.size());
  for (std::size_t k = 0; k < one.plan.robots.size(); ++k)
    EXPECT_EQ(one.plan.robots[k].at(1.3).pose, three.plan.robots[k].at(1.3).pose);
}

TEST(NetPlan, GoesOnFromAnEarlierPlanWhileDriving) {
  const world::Scenario scenario = world::throw_scene(4, 5);
  const PlanResult first = plan(scenario, {.threads = 1});
  ASSERT_TRUE(first.certified) << first.reason;
  // A third of a second later the clock starts anew, from where the team then is.
  constexpr double kNow = 0.3;
  world::Scenario later = scenario;
  for (std::size_t k = 0; k < later.robots.size(); ++k) {
    const traj::State state = first.plan.robots[k].at(kNow);
    later.robots[k].start = state.pose;
    later.robots[k].start_speed = state.speed;
  }
  net::Target& target = later.targets.front();
  const net::FlightState flying = net::Flight(scenario.targets.front()).at(kNow);
  if (target.time > kNow) {
    target.time -= kNow;
  } else {
    target.time = 0.0, target.position = flying.position, target.velocity = flying.velocity;
  }
  target.position.x += 0.05;
  const PlanResult second = plan(later, {.threads = 1, .previous = &first.plan, .previous_time = kNow});
  ASSERT_TRUE(second.certified) << second.reason;
  EXPECT_EQ(second.times.guess, 0.0) << "no new guess was needed";
  expect_carried(later, second.plan);
}

TEST(NetPlan, TheImpossibleIsRefusedWithItsReason) {
  world::Scenario scenario = world::throw_scene(4, 1);
  scenario.obstacles.clear();
  net::Target& target = scenario.targets.front();
  const auto reason = [&] { return plan(scenario, {.threads = 1}).reason; };
  target = {
      .time = 0.0, .position = {scenario.robots[0].start.x + 7.0, 0.0, 3.0}, .velocity = {0.0, 0.0, 1.0}};
  EXPECT_NE(reason().find("cannot be reached: the team needs at least"), std::string::npos) << reason();
  const Vec2 near = scenario.robots[0].start.position();
  target = {.time = 1.0, .position = {near.x - 9.0, near.y, 2.0}, .velocity = {9.0, 0.0, 3.0}};
  EXPECT_NE(reason().find("too flat"), std::string::npos) << reason();
  target = {.time = 3.0, .position = {near.x + 1.0, near.y, 20.0}, .velocity = {0.0, 0.0, -8.0}};
  EXPECT_NE(reason().find("too fast"), std::string::npos) << reason();
}

// The bound must never refuse what a plan shows to be possible.
// A team that stands around the origin in an empty world, a load in its net.
world::Scenario standing_team(int robots, double heading) {
  world::Scenario scenario;
  scenario.name = "standing";
  scenario.bounds = {{-15.0, -15.0}, {15.0, 15.0}};
  scenario.models = {world::standard_car()};
  scenario.net = world::family_net(robots);
  for (int k = 0; k < robots; ++k) {
    const Vec2 corner = 0.92 * scenario.net->rest[static_cast<std::size_t>(k)];
    const Vec2 axle = corner - 0.2 * geom::unit(heading);
    scenario.robots.push_back({.name = "car" + std::to_string(k), .start = {axle.x, axle.y, heading}});
  }
  scenario.payload = net::Payload{};
  return scenario;
}

TEST(NetPlan, ShortMovesAreShort) {
  Rng rng(11);
  for (int round = 0; round < 24; ++round) {
    world::Scenario scenario = standing_team(3 + round % 4, rng.uniform(-3.0, 3.0));
    const double radii[] = {0.01, 0.03, 0.1, 0.5}, gaps[] = {0.0, 1e-3, 0.02, 0.1, 0.3, 1.0, 3.0};
    const double radius = radii[rng.below(4)], gap = gaps[rng.below(7)];
    const Vec2 to = (gap + radius) * geom::unit(rng.uniform(-3.14, 3.14));
    scenario.delivery = net::Delivery{to, radius, std::nullopt};
    const PlanResult result = plan(scenario, {.threads = 1});
    ASSERT_TRUE(result.certified) << round << ", " << gap << " m: " << result.reason;
    expect_carried(scenario, result.plan);
    // Sideways a car goes forth and back; nobody drives round in a loop.
    const double each = result.quality.distance / static_cast<double>(scenario.robots.size());
    EXPECT_LT(each, 1.3 * gap + 4.0 * std::sqrt(gap * 0.5) * 0.5 + 0.25) << round << ", " << gap << " m";
  }
}

TEST(NetPlan, NothingToDoIsNothingDone) {
  for (const int robots : {3, 4, 6}) {
    world::Scenario scenario = standing_team(robots, 0.4);
    const auto expect_stay = [&] {
      const PlanResult result = plan(scenario, {.threads = 1});
      ASSERT_TRUE(result.certified) << result.reason;
      EXPECT_EQ(result.quality.makespan, 0.0);
    };
    expect_stay();  // nothing asked
    scenario.delivery = net::Delivery{{0.1, 0.0}, 0.3, std::nullopt};
    expect_stay();
    scenario.delivery.reset();
    for (world::Robot& robot : scenario.robots) robot.goal = robot.start;
    expect_stay();
    for (world::Robot& robot : scenario.robots) robot.goal.reset();
    scenario.payload.reset();
    net::Target target;
    target.position = {0.05, 0.05, 3.0};
    scenario.targets = {target};
    expect_stay();  // it falls into the net
  }
}

TEST(NetPlan, GoalsNearByAreReached) {
  for (const int robots : {3, 4, 6})
    for (const double ahead : {0.01, 0.3, -0.3}) {
      world::Scenario scenario = standing_team(robots, 0.0);
      for (world::Robot& robot : scenario.robots)
        robot.goal = geom::Pose2{robot.start.x + ahead, robot.start.y, 0.0};
      const PlanResult result = plan(scenario, {.threads = 1});
      ASSERT_TRUE(result.certified) << robots << " cars, " << ahead << " m: " << result.reason;
      EXPECT_LT(result.quality.distance / robots, std::abs(ahead) + 0.05);
    }
}

TEST(NetPlan, WhatTheAirPushesIsCarriedSlowly) {
  for (const double drag : {0.5, 2.0, 8.0}) {
    world::Scenario scenario = standing_team(4, 0.0);
    scenario.payload.reset();
    net::Target target;
    target.position = {1.0, 0.3, 3.0}, target.velocity = {0.0, 0.0, 2.0}, target.drag = drag;
    scenario.targets = {target};
    scenario.delivery = net::Delivery{{3.0, 1.0}, 0.3, std::nullopt};
    const PlanResult result = plan(scenario, {.threads = 1});
    ASSERT_TRUE(result.certified) << drag << ": " << result.reason;
    const double caught = net::Flight(target).crossing(scenario.net->rim())->state.time;
    for (const traj::RobotTrajectory& way : result.plan.robots)
      for (double t = caught; t < way.arrival(); t += 0.01)
        ASSERT_LE(std::abs(way.at(t).speed), net::carry_speed(drag) + 1e-3) << drag << ", " << t << " s";
  }
}

TEST(NetPlan, TheLeastTimeIsABound) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const world::Scenario scenario = world::throw_scene(3 + static_cast<int>(seed % 2), seed);
    const PlanResult result = plan(scenario, {.threads = 1});
    if (!result.certified) continue;
    // At every instant of the plan the disc that the net then holds was within reach.
    for (double t = 0.2; t < result.plan.makespan(); t += 0.2) {
      const std::vector<Vec2> ring = ring_at(scenario, result.plan, t);
      Vec2 middle;
      for (const Vec2 a : ring) middle += a / static_cast<double>(ring.size());
      EXPECT_LE(least_time(scenario, middle, net::margin_inside(ring, middle)), t) << "seed " << seed;
    }
  }
}

TEST(NetPlan, AblationsLeaveThingsOut) {
  const world::Scenario scenario = world::throw_scene(3, 0);
  const PlanResult all = plan(scenario, {.threads = 1});
  ASSERT_TRUE(all.certified) << all.reason;
  const PlanResult without = plan(scenario, {.threads = 1, .without = {.catching = true}});
  ASSERT_EQ(without.certificate.catches.size(), 1u);
  EXPECT_LT(without.certificate.catches[0].rim_margin, all.certificate.catches[0].rim_margin);
}

}  // namespace
}  // namespace seine::planner
