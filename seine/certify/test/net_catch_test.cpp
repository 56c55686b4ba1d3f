// Catches that just are, or just are not, what the rules of a physical catch ask.
#include <gtest/gtest.h>

#include "seine/certify/test/brute_force.hpp"
#include "seine/certify/test/net_plans.hpp"

namespace seine::certify::test {
namespace {

constexpr double kRadius = 1.4, kOpen = 0.92;      // of the square net
constexpr double kSpeed = 0.5 * std::numbers::pi;  // m/s, of the team half way, when it is fastest
constexpr double kHalfWay = 1.0;                   // s

/// A square net, its corners on the axes, that drives 2 m along x from t = 0 to t = 2.
NetTeam catching_team(double open = kOpen) {
  NetTeam team = driving_team(regular(4, open * kRadius), regular(4, kRadius), 2.0, 2.0);
  team.net().clearance = 0.05;
  return team;
}

/// Falls through the rim at `place`, `time` with this velocity.
net::Target falling(Vec2 place, double time, geom::Vec3 velocity) {
  net::Target target = drop(place, time, -velocity.z);
  const double fall = time - target.time;
  target.velocity.x = velocity.x, target.velocity.y = velocity.y;
  target.position.x -= fall * velocity.x, target.position.y -= fall * velocity.y;
  return target;
}

void expect_catch(const NetTeam& team, bool holds) {
  const Certificate certificate = team.judge();
  EXPECT_EQ(certificate.holds, holds) << summary(certificate);
  for (const Violation& v : certificate.violations)
    EXPECT_EQ(v.kind, Kind::target_catch) << summary(certificate);
}

TEST(PlantedCatch, IsMeasuredInTheMovingNet) {
  NetTeam team = catching_team();
  // The middle of the net is at x = 1 half way and drives at kSpeed: the target falls straight down in it.
  team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
  const Certificate certificate = team.judge();
  EXPECT_TRUE(certificate.holds) << summary(certificate);
  ASSERT_EQ(certificate.catches.size(), 1u);
  const net::Catch& caught = certificate.catches.front();
  const double inside = kOpen * kRadius / std::sqrt(2.0);
  EXPECT_NEAR(caught.time, kHalfWay, 1e-9);
  EXPECT_NEAR(caught.rim_margin, inside - 0.08, 1e-2);
  EXPECT_NEAR(caught.contact_margin, inside - 0.08, 1e-2);
  EXPECT_NEAR(caught.opening, kOpen, 1e-9);
  EXPECT_NEAR(caught.depth, kRadius * std::sqrt(1.0 - kOpen * kOpen), 1e-6);
  EXPECT_NEAR(caught.angle, 0.0, 1e-2);
  EXPECT_NEAR(caught.speed, 6.0, 1e-2);
}

TEST(PlantedCatch, ItsFlightIsFree) {
  // It comes along y from the side, over a wall beside the way of the net and past a gate that shuts.
  NetTeam team = catching_team();
  team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
  net::Target& target = team.scenario.targets[0];
  target.time = 0.2;
  const double flies = kHalfWay - target.time;
  target.velocity = {0.0, 5.0, -6.0 + 9.80665 * flies};
  target.position = {1.0, -5.0 * flies, 1.0 - flies * target.velocity.z + 0.5 * 9.80665 * flies * flies};
  const auto with = [&](double height, std::vector<world::Waypoint> motion) {
    std::vector<Vec2> wall{{-2.0, -0.05}, {2.0, -0.05}, {2.0, 0.05}, {-2.0, 0.05}};
    if (motion.empty())
      for (Vec2& p : wall) p += {1.0, -3.0};
    team.scenario.obstacles = {
        {.name = "wall", .shape = wall, .height = height, .motion = std::move(motion)}};
    return team.judge();
  };
  const auto without = [&] {
    team.scenario.obstacles.clear();
    return team.judge();
  }();
  // At y = −3.13 … −2.87 it is 0.2 to 0.25 s on its way.
  const double low = target.position.z + 0.2 * target.velocity.z - 0.5 * 9.80665 * 0.04;
  EXPECT_EQ(with(low - 0.4, {}).violations.size(), without.violations.size());
  EXPECT_EQ(with(low + 0.2, {}).violations.size(), without.violations.size() + 1);
  EXPECT_TRUE(breaks(with(low + 0.2, {}), Kind::target_catch));
  // Somewhere else until the object has passed, or there in between only.
  EXPECT_EQ(with(low + 0.2, {{0.5, {9.0, -3.0, 0.0}}, {0.6, {1.0, -3.0, 0.0}}}).violations.size(),
            without.violations.size());
  EXPECT_EQ(with(low + 0.2, {{0.3, {9.0, -3.0, 0.0}}, {0.4, {1.0, -3.0, 0.0}}, {0.5, {9.0, -3.0, 0.0}}})
                .violations.size(),
            without.violations.size() + 1);
}

TEST(PlantedCatch, WhatIsThrownFromBelowComesRoundTheNet) {
  // Thrown up from the ground inside the ring, or outside it: it falls back into the middle in both cases.
  for (const double away : {0.0, 4.0}) {
    NetTeam team = parked_team(regular(4, kOpen * kRadius), regular(4, kRadius));
    team.net().clearance = 0.05;
    net::Target target;
    target.position = {-away, 0.0, 0.3};
    target.velocity = {0.0, 0.0, 6.0};
    const double until = net::Flight(target).crossing(1.0)->state.time;
    target.velocity.x = away / until;
    team.scenario.targets = {target};
    const Certificate certificate = team.judge();
    const bool through = std::any_of(
        certificate.violations.begin(), certificate.violations.end(),
        [](const Violation& v) { return v.text.find("rises through the net") != std::string::npos; });
    EXPECT_EQ(through, away == 0.0) << summary(certificate);
  }
}

TEST(PlantedCatch, APayloadNeedsRoomInTheNet) {
  NetTeam team = parked_team(regular(4, kOpen * kRadius), regular(4, kRadius));
  team.net().clearance = 0.05;
  const double widest = kRadius * std::sqrt(0.5);
  for (const double beyond : {-1e-3, 1e-3, 49.0}) {
    team.scenario.payload = net::Payload{widest + beyond, 0.25};
    EXPECT_EQ(team.judge().holds, beyond < 0.0) << summary(team.judge());
  }
}

TEST(PlantedCatch, MarginAtTheRim) {
  // Along y the net has no speed: a target that falls straight down meets the rim where it meets the net.
  const double corner = kOpen * kRadius, off = std::sqrt(2.0) * (net::kRimMargin + 0.08);
  for (const double beyond : {-1e-3, 1e-3}) {
    NetTeam team = catching_team();
    team.scenario.targets = {
        falling({1.0, corner - off + std::sqrt(2.0) * beyond}, kHalfWay, {kSpeed, 0.0, -6.0})};
    expect_catch(team, beyond < 0.0);
    // The prediction error counts.
    team.scenario.targets[0].covariance[1][1] = 1e-4;
    expect_catch(team, false);
  }
}

TEST(PlantedCatch, MarginWhereItMeetsTheNet) {
  // It slides sideways by depth · tan(angle) until then.
  const double depth = kRadius * std::sqrt(1.0 - kOpen * kOpen), slide = depth * 3.0 / 6.0;
  const double corner = kOpen * kRadius, off = std::sqrt(2.0) * (net::kContactMargin + 0.08);
  for (const double beyond : {-1e-3, 1e-3}) {
    NetTeam team = catching_team();
    const double y = corner - off - slide + std::sqrt(2.0) * beyond;
    team.scenario.targets = {falling({1.0, y}, kHalfWay, {kSpeed, 3.0, -6.0})};
    expect_catch(team, beyond < 0.0);
  }
}

TEST(PlantedCatch, AngleAndSpeedAreRelativeToTheNet) {
  for (const double off : {-1e-2, 1e-2}) {
    NetTeam team = catching_team();
    // As fast sideways as down, in the net's eyes; from the ground it looks steeper.
    team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed - 5.0 - off, 0.0, -5.0})};
    expect_catch(team, off < 0.0);
    const double depth = kRadius * std::sqrt(1.0 - kOpen * kOpen);
    const double fastest = net::speed_limit(depth, 0.08, team.net().rebound);
    ASSERT_LT(fastest, net::kMaxSpeed);
    team.net().clearance = -1.0;
    team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -fastest - off})};
    expect_catch(team, off < 0.0);
  }
}

TEST(PlantedCatch, Opening) {
  for (const double open : {net::kLeastOpening - 1e-3, net::kLeastOpening + 1e-3}) {
    NetTeam team = catching_team(open);
    team.net().clearance = 0.0;
    team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
    expect_catch(team, open > net::kLeastOpening);
  }
}

TEST(PlantedCatch, ClosesTooSoon) {
  // Opened for the catch at t = 0.5; 0.9 s or 1.1 s later it is at 0.85.
  for (const double later : {0.9, 1.1}) {
    traj::TeamTrajectory plan;
    for (const Vec2 corner : regular(4, 0.92 * kRadius)) {
      auto way = straight({corner.x, corner.y, std::atan2(-corner.y, -corner.x)}, 0.07 * kRadius, 0.02);
      way.segments.front().wait = 0.5 + later;
      plan.robots.push_back(way);
    }
    NetTeam team = net_team(plan, regular(4, kRadius), {0.0, 0.0});
    team.scenario.targets = {falling({0.0, 0.0}, 0.5, {0.0, 0.0, -4.0})};
    const Certificate certificate = team.judge();
    EXPECT_EQ(breaks(certificate, Kind::net_opening), later < 1.0) << summary(certificate);
  }
}

TEST(PlantedCatch, TooShallowForTheImpact) {
  // The heavier, the deeper it carries the net.
  for (const double mass : {0.25, 2.0}) {
    NetTeam team = catching_team();
    team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
    team.scenario.targets[0].mass = mass;
    expect_catch(team, mass < 1.0);
  }
  // Something low under the net at that instant takes its height away; a moment later it is no matter of the
  // catch.
  for (const double height : {0.05, 0.25}) {
    NetTeam team = catching_team();
    team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
    team.scenario.obstacles = {
        {.name = "step", .shape = world::Circle{{1.0, 0.5}, 0.1}, .height = height, .motion = {}}};
    expect_catch(team, height < 0.1);
    team.scenario.obstacles[0].shape = world::Circle{{9.0, 0.0}, 0.1};
    team.scenario.obstacles[0].motion = {{kHalfWay - 0.1, {-9.0, 9.0, 0.0}}, {kHalfWay, {-8.0, 0.0, 0.0}}};
    expect_catch(team, height < 0.1);
  }
}

// Parked until 1.2 s after the catch, then all drive on at up to `speed`.
NetTeam team_that_carries_on(double speed) {
  constexpr double kCatch = 0.5, kTop = 0.5 * std::numbers::pi;  // of a drive's mean speed
  NetTeam team = driving_team(regular(4, kOpen * kRadius), regular(4, kRadius), 2.0, 2.0 * kTop / speed);
  for (traj::RobotTrajectory& way : team.plan.robots) way.segments.front().wait = kCatch + 1.2;
  team.scenario.targets = {falling({0.0, 0.0}, kCatch, {0.0, 0.0, -4.0})};
  team.net().clearance = 0.0;
  return team;
}

TEST(PlantedCatch, CarriedTooFastForItsDrag) {
  for (const double drag : {1.0, 2.0, 8.0})
    for (const double share : {0.98, 1.02}) {
      NetTeam team = team_that_carries_on(share * net::carry_speed(drag));
      // A flight with drag that falls through the rim at the same time and place.
      net::Target& target = team.scenario.targets[0];
      target.drag = drag, target.velocity = {};
      target.time = 0.0, target.position = {0.0, 0.0, 1.5};
      const Certificate certificate = team.judge();
      EXPECT_EQ(certificate.holds, share < 1.0) << summary(certificate);
      EXPECT_EQ(breaks(certificate, Kind::carrying), share > 1.0) << summary(certificate);
      target.drag = 0.0;
      EXPECT_TRUE(team.judge().holds);
    }
}

TEST(PlantedCatch, OfManyWithDragTheStrictestCounts) {
  for (const double share : {0.98, 1.02}) {
    NetTeam team = team_that_carries_on(share * net::carry_speed(2.0));
    net::Target target = team.scenario.targets[0];
    target.velocity = {}, target.time = 0.0, target.position = {0.0, 0.0, 1.5};
    team.scenario.targets.clear();
    for (int i = 0; i <= 60; ++i) {  // each a little stricter than the one before
      target.drag = 2.0 * std::pow(0.9, 60 - i);
      team.scenario.targets.push_back(target);
    }
    EXPECT_EQ(breaks(team.judge(), Kind::carrying), share > 1.0) << summary(team.judge());
  }
}

TEST(PlantedCatch, NeverComes) {
  NetTeam team = catching_team();
  const auto falls = [&](net::Target target) {
    team.scenario.targets = {target};
    return team.judge();
  };
  // Below the rim from the beginning; through it before the plan begins.
  Certificate never = falls({.position = {1.0, 0.0, 0.5}, .velocity = {}});
  EXPECT_TRUE(breaks(never, Kind::target_catch)) << summary(never);
  ASSERT_EQ(never.catches.size(), 1u);
  EXPECT_TRUE(std::isnan(never.catches.front().time));
  never = falls({.time = -3.0, .position = {1.0, 0.0, 2.0}, .velocity = {}});
  EXPECT_TRUE(breaks(never, Kind::target_catch)) << summary(never);
  // Beside the net; long after the team has arrived.
  expect_catch(team, false);
  team.scenario.targets = {falling({1.0, 3.0}, kHalfWay, {kSpeed, 0.0, -6.0})};
  expect_catch(team, false);
  team.scenario.targets = {falling({2.0, 0.0}, 60.0, {0.0, 0.0, -6.0})};
  expect_catch(team, true);
  team.scenario.targets = {falling({1.0, 0.8}, 60.0, {0.0, 0.0, -6.0})};
  expect_catch(team, false);
}

TEST(PlantedCatch, OneOfTwo) {
  NetTeam team = catching_team();
  team.scenario.targets = {falling({1.0, 0.0}, kHalfWay, {kSpeed, 0.0, -6.0}),
                           falling({2.0, 0.0}, 3.0, {0.0, 0.0, -6.0})};
  expect_catch(team, true);
  ASSERT_EQ(team.judge().catches.size(), 2u);
  EXPECT_NEAR(team.judge().catches[1].time, 3.0, 1e-9);
  team.scenario.targets[1].position.x += 0.9;
  expect_catch(team, false);
  const Certificate missed = team.judge();
  ASSERT_EQ(missed.violations.size(), 1u);
  EXPECT_EQ(missed.violations.front().other, 1);
}

TEST(PlantedCatch, BrakesTooHardWithSomethingInTheNet) {
  // π²/2 m/s² at the start and at the end, nothing half way.
  NetTeam team = driving_team(regular(4, kOpen * kRadius), regular(4, kRadius), 4.0, 2.0);
  const auto catches_at = [&](double time) {
    const double s = 2.0 * (1.0 - std::cos(0.5 * std::numbers::pi * time));
    const double v = std::numbers::pi * std::sin(0.5 * std::numbers::pi * time);
    team.scenario.targets = {falling({s, 0.0}, time, {v, 0.0, -6.0})};
    return team.judge();
  };
  const Certificate early = catches_at(1.0);
  EXPECT_TRUE(breaks(early, Kind::braking, 2)) << summary(early);
  for (const Violation& v : early.violations) EXPECT_EQ(v.kind, Kind::braking) << summary(early);
  EXPECT_NEAR(early.violations.front().value, 0.5 * std::numbers::pi * std::numbers::pi, 0.05);
  // From rest it may start as hard as it can, before the catch; after both it is at rest.
  const Certificate late = catches_at(2.0);
  EXPECT_TRUE(late.holds) << summary(late);
  // A payload lies in it from the beginning.
  team.scenario.targets.clear();
  EXPECT_TRUE(team.judge().holds) << summary(team.judge());
  team.scenario.payload = net::Payload{};
  EXPECT_TRUE(breaks(team.judge(), Kind::braking, 2)) << summary(team.judge());
}

TEST(PlantedCatch, APayloadIsBrakedJustAsHardAsAllowed) {
  for (const double share : {0.99, 1.01}) {  // of the limit at the start and at the end
    const double duration = std::numbers::pi * std::sqrt(2.0 / (share * net::kBraking));
    NetTeam team = driving_team(regular(4, kOpen * kRadius), regular(4, kRadius), 4.0, duration);
    team.scenario.payload = net::Payload{};
    EXPECT_EQ(breaks(team.judge(), Kind::braking), share > 1.0) << summary(team.judge());
  }
}

TEST(PlantedCatch, MayAccelerateHardUntilTheCatch) {
  // Hard at first, gently afterwards: when the target falls in decides.
  traj::TeamTrajectory plan;
  for (const Vec2 corner : regular(4, kOpen * kRadius)) {
    plan.robots.push_back(straight({corner.x - 0.2, corner.y, 0.0}, 2.0, 2.0));
    traj::Segment& segment = plan.robots.back().segments.front();
    segment.progress = rest_to_rest(1.0, 8, 0.2), segment.piece_duration = 0.25;
  }
  NetTeam team = net_team(plan, regular(4, kRadius), {0.2, 0.0});
  double gentle = 0.0;
  while (plan.robots[0].at(gentle).acceleration > net::kBraking) gentle += 1e-4;
  ASSERT_GT(gentle, 0.1);
  ASSERT_LT(gentle, 1.0);
  for (const double off : {-1e-3, 1e-3}) {
    const traj::State then = plan.robots[0].at(gentle + off);
    team.scenario.targets = {
        falling({then.pose.x + 0.2 - kOpen * kRadius, 0.0}, gentle + off, {then.speed, 0.0, -6.0})};
    const Certificate certificate = team.judge();
    EXPECT_EQ(certificate.holds, off > 0.0) << summary(certificate);
    for (const Violation& v : certificate.violations)
      EXPECT_EQ(v.kind, Kind::braking) << summary(certificate);
  }
}

}  // namespace
}  // namespace seine::certify::test
