#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/planner/net_question.hpp"
#include "seine/planner/planner.hpp"
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
