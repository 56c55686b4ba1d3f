// Plans with one planted fault each, that a look at samples could miss: not one may pass.
#include <gtest/gtest.h>

#include <functional>

#include "seine/base/error.hpp"
#include "seine/certify/test/brute_force.hpp"

namespace seine::certify::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Certificate judge(const world::Scenario& scenario, const traj::TeamTrajectory& plan) {
  return certify(scenario, world::StaticMap(scenario), plan);
}

void expect_only(const Certificate& certificate, Kind kind) {
  EXPECT_FALSE(certificate.holds);
  EXPECT_TRUE(breaks(certificate, kind)) << summary(certificate);
  for (const Violation& v : certificate.violations) EXPECT_EQ(v.kind, kind) << summary(certificate);
}

/// Two cars that are far apart, the first with a cusp, everything kept: each test breaks one thing of it.
struct Sound {
  traj::TeamTrajectory plan;
  world::Scenario scenario;
  Sound() {
    Rng rng(31);
    const Shape bent{
        .segments = 2, .curve_pieces = 3, .progress_pieces = 4, .piece_length = 1.0, .piece_duration = 1.0};
    plan.robots = {random_way(rng, {{0.0, 0.0, 0.3}, 0.1}, bent), straight({20.0, 0.0, 1.0}, 3.0, 4.0)};
    scenario = scenario_for(plan, car(), 100.0);
    scenario.margins = {0.05, 0.05};
  }
};

TEST(Planted, TheSoundPlanHolds) {
  const Sound sound;
  const Certificate certificate = judge(sound.scenario, sound.plan);
  EXPECT_TRUE(certificate.holds) << summary(certificate);
}

TEST(Planted, Malformed) {
  using Spoil = std::function<void(traj::TeamTrajectory&)>;
  const auto segment = [](traj::TeamTrajectory& p) -> traj::Segment& { return p.robots[0].segments[1]; };
  const std::vector<std::pair<const char*, Spoil>> spoils{
      {"missing robot", [](auto& p) { p.robots.pop_back(); }},
      {"extra robot", [](auto& p) { p.robots.push_back(p.robots[0]); }},
      {"no robots", [](auto& p) { p.robots.clear(); }},
      {"no segments", [](auto& p) { p.robots[1].segments.clear(); }},
      {"segments and a stand", [](auto& p) { p.robots[1].stands = p.robots[1].at(0.0).pose; }},
      {"NaN stand",
       [](auto& p) {
         p.robots[1] = traj::RobotTrajectory::standing({kNaN, 0.0, 0.0});
       }},
      {"no curve", [&](auto& p) { segment(p).curve.clear(); }},
      {"no progress", [&](auto& p) { segment(p).progress.clear(); }},
      {"negative duration", [&](auto& p) { segment(p).piece_duration = -1.0; }},
      {"zero duration", [&](auto& p) { segment(p).piece_duration = 0.0; }},
      {"infinite duration",
       [&](auto& p) { segment(p).piece_duration = std::numeric_limits<double>::infinity(); }},
      {"NaN duration", [&](auto& p) { segment(p).piece_duration = kNaN; }},
      {"negative wait", [&](auto& p) { segment(p).wait = -0.1; }},
      {"NaN wait", [&](auto& p) { segment(p).wait = kNaN; }},
      {"gear 0", [&](auto& p) { segment(p).gear = 0; }},
      {"gear 2", [&](auto& p) { segment(p).gear = 2; }},
      {"no tangent",
       [&](auto& p) {
         segment(p).curve[1] = {Quintic{1.0}, Quintic{2.0}};
       }},
  };
  for (const auto& [name, spoil] : spoils) {
    Sound sound;
    spoil(sound.plan);
    const Certificate certificate = judge(sound.scenario, sound.plan);
    EXPECT_TRUE(!certificate.holds && breaks(certificate, Kind::malformed))
        << name << ": " << summary(certificate);
  }
}

TEST(Planted, NotANumberAnywhere) {
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), 1e300}) {
    for (std::size_t k = 0; k < 6; ++k) {
      for (int where = 0; where < 3; ++where) {
        Sound sound;
        traj::Segment& segment = sound.plan.robots[0].segments[1];
        (where < 2 ? segment.curve[2][static_cast<std::size_t>(where)] : segment.progress[3])[k] = bad;
        expect_only(judge(sound.scenario, sound.plan), Kind::malformed);
      }
    }
  }
}

TEST(Planted, WrongStartOrGoal) {
  using Spoil = std::function<void(world::Robot&)>;
  const std::vector<std::tuple<const char*, Kind, Spoil>> spoils{
      {"start x", Kind::start, [](auto& r) { r.start.x += 2e-4; }},
      {"start y", Kind::start, [](auto& r) { r.start.y -= 2e-4; }},
      {"start heading", Kind::start, [](auto& r) { r.start.heading += 2e-4; }},
      {"start opposite", Kind::start, [](auto& r) { r.start.heading += std::numbers::pi; }},
      {"start speed", Kind::start, [](auto& r) { r.start_speed = 0.01; }},
      {"goal x", Kind::goal, [](auto& r) { r.goal->x -= 2e-4; }},
      {"goal y", Kind::goal, [](auto& r) { r.goal->y += 2e-4; }},
      {"goal heading", Kind::goal, [](auto& r) { r.goal->heading -= 2e-4; }},
  };
  for (const auto& [name, kind, spoil] : spoils) {
    Sound sound;
    spoil(sound.scenario.robots[0]);
    SCOPED_TRACE(name);
    expect_only(judge(sound.scenario, sound.plan), kind);
  }
}

TEST(Planted, WhatIsNoNumberIsNoQuestion) {
  Sound start, goal;
  start.scenario.robots[0].start.x = kNaN;
  goal.scenario.robots[0].goal->heading = kNaN;
  EXPECT_THROW(judge(start.scenario, start.plan), InputError);
  EXPECT_THROW(judge(goal.scenario, goal.plan), InputError);
}

TEST(Planted, AFullTurnOfHeadingIsNoDifference) {
  Sound sound;
  sound.scenario.robots[0].start.heading += 2.0 * std::numbers::pi;
  EXPECT_TRUE(judge(sound.scenario, sound.plan).holds);
}

TEST(Planted, Discontinuity) {
  using Spoil = std::function<void(std::vector<traj::Segment>&)>;
  const auto shift = [](Quintic& c, double by) { c[0] += by; };
  // Bends the middle piece without moving its beginning: value, slope and curvature at its end are off.
  const std::vector<std::pair<const char*, Spoil>> spoils{
      {"curve piece shifted", [&](auto& s) { shift(s[0].curve[1][0], 1e-3); }},
      {"last segment shifted",
       [&](auto& s) {
         for (auto& piece : s[1].curve) shift(piece[1], 1e-4);
       }},
      {"curvature jumps at a knot",
       [](auto& s) {
         auto& c = s[0].curve[1][1];  // w³(1 − w)² keeps values and slopes at both ends
         c[3] += 0.05, c[4] -= 0.1, c[5] += 0.05;
       }},
      {"progress jumps", [&](auto& s) { shift(s[0].progress[2], 1e-3); }},
      {"speed jumps",
       [](auto& s) {
         auto& c = s[0].progress[1];  // w²(w − 1) keeps the values
         c[2] -= 0.05, c[3] += 0.05;
       }},
      {"progress runs off the curve", [](auto& s) { s[0].curve.pop_back(); }},
      {"heading jumps between segments", [](auto& s) { s[1].gear = s[0].gear; }},
  };
  for (const auto& [name, spoil] : spoils) {
    Sound sound;
    spoil(sound.plan.robots[0].segments);
    const Certificate certificate = judge(sound.scenario, sound.plan);
    EXPECT_TRUE(!certificate.holds && breaks(certificate, Kind::continuity))
        << name << ": " << summary(certificate);
  }
}

TEST(Planted, NotAtRest) {
  // Stops 2 mm/s short of standing still, at the end, at a cusp, before a wait.
  for (int where = 0; where < 2; ++where) {
    Sound sound;
    auto& progress = sound.plan.robots[0].segments[where == 0 ? 1 : 0].progress.back();
    progress[2] -= 0.002, progress[3] += 0.002;  // w²(w − 1) · 0.002
    expect_only(judge(sound.scenario, sound.plan), Kind::rest);
  }
}

TEST(Planted, AWaitInTheMiddleOfMotion) {
  // One straight way cut in the middle, where it is fastest, with a wait between the halves.
  traj::TeamTrajectory plan{{straight({0, 0, 0}, 4.0, 4.0)}};
  traj::Segment first = plan.robots[0].segments[0], second = first;
  first.progress.resize(2);
  second.progress.erase(second.progress.begin(), second.progress.begin() + 2);
  plan.robots[0].segments = {first, second};
  const world::Scenario scenario = scenario_for(plan, car(), 100.0);
  const Certificate sound = judge(scenario, plan);
  EXPECT_TRUE(sound.holds) << summary(sound);
  plan.robots[0].segments[1].wait = 0.01;
  expect_only(judge(scenario, plan), Kind::rest);
}

TEST(Planted, AgainstTheGear) {
  Sound sound;
  // Swings back by a few millimetres in the middle of the way and on again.
  auto& segment = sound.plan.robots[0].segments[0];
  const auto at = [&](double u, double slope) { return std::array<double, 3>{u, slope, 0.0}; };
  segment.progress = {hermite(at(0, 0), at(1.5, 0.0)), hermite(at(1.5, 0), at(1.499, 0.0)),
                      hermite(at(1.499, 0), at(3, 0))};
  const Certificate certificate = judge(sound.scenario, sound.plan);
  expect_only(certificate, Kind::gear);
}

TEST(Planted, SteeringMayJumpOnlyAtRestWithTime) {
  Sound sound;
  auto& segments = sound.plan.robots[0].segments;
  // The second segment starts with another curvature at the same pose.
  const traj::State cusp = traj::evaluate(segments[1], 0.0);
  auto& first = segments[1].curve[0];
  const traj::State next = traj::evaluate(
      {.gear = segments[1].gear, .curve = {segments[1].curve[1]}, .progress = {Quintic{}}}, 0.0);
  first = curve_piece({cusp.pose, cusp.curvature + 0.5}, {next.pose, next.curvature}, segments[1].gear, 1.0);
  vehicle::Limits& limits = sound.scenario.models[0].limits;
  EXPECT_TRUE(judge(sound.scenario, sound.plan).holds) << summary(judge(sound.scenario, sound.plan));
  limits.steering_rate = 50.0;
  expect_only(judge(sound.scenario, sound.plan), Kind::continuity);
  segments[1].wait = 0.001;
  expect_only(judge(sound.scenario, sound.plan), Kind::continuity);
  segments[1].wait = 0.01;
  EXPECT_TRUE(judge(sound.scenario, sound.plan).holds) << summary(judge(sound.scenario, sound.plan));
}

// ---- limits broken for a millisecond
// ---------------------------------------------------------------------------------

/// Cruises around a circle at 2 m/s in pieces of half a millisecond and one millimetre; one knot of the
/// progress or of the curve is bumped, which shows for one millisecond.
struct Cruise {
  static constexpr int kPieces = 400;
  static constexpr double kStep = 0.5e-3, kLength = 1e-3, kCurvature = 0.5;
  double rate_bump = 0.0, acceleration_bump = 0.0, curvature_bump = 0.0;

  traj::TeamTrajectory plan() const {
    traj::Segment segment;
    segment.piece_duration = kStep;
    const auto knot = [&](int i) {
      Bent at = drive({{}, kCurvature}, kCurvature, 1, 1e-12);
      const double angle = kCurvature * kLength * i;
      at.pose = {std::sin(angle) / kCurvature, (1.0 - std::cos(angle)) / kCurvature, angle};
      if (i == kPieces / 2) at.curvature += curvature_bump;
      return at;
    };
    const auto progress = [&](int j) {
      const bool bumped = j == kPieces / 2;
      return std::array<double, 3>{static_cast<double>(j), 1.0 + (bumped ? rate_bump : 0.0),
                                   bumped ? acceleration_bump : 0.0};
    };
    for (int i = 0; i < kPieces; ++i) {
      segment.curve.push_back(curve_piece(knot(i), knot(i + 1), 1, kLength));
      segment.progress.push_back(hermite(progress(i), progress(i + 1)));
    }
    // A stop at the end, 1 m on: quickly braked, so that the cruise stands out by its speed only.
    traj::Segment stop;
    const Bent from = knot(kPieces), to = drive(from, kCurvature, 1, 1.0);
    stop.curve.push_back(curve_piece(from, to, 1, 1.0));
    stop.piece_duration = 1.0;
    stop.progress.push_back(hermite({0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}));
    return {{{{segment, stop}}}};
  }
};

void expect_millisecond(const Cruise& bumped, Kind kind, double vehicle::Limits::*limit, double allowed) {
  const traj::TeamTrajectory smooth = Cruise{}.plan(), plan = bumped.plan();
  world::Scenario scenario = scenario_for(smooth, car(), 100.0);
  scenario.robots[0].start_speed = 2.0;
  scenario.models[0].limits.*limit = allowed;
  const Certificate before = judge(scenario, smooth);
  EXPECT_TRUE(before.holds) << summary(before);
  const Certificate after = judge(scenario, plan);
  expect_only(after, kind);
  // Outside of the millisecond nothing is wrong.
  const double middle = Cruise::kPieces / 2 * Cruise::kStep;
  for (const Violation& v : after.violations) EXPECT_NEAR(v.time, middle, Cruise::kStep);
}

TEST(Planted, LimitsBrokenForAMillisecond) {
  expect_millisecond({.rate_bump = 1e-3}, Kind::speed, &vehicle::Limits::speed, 2.0005);
  expect_millisecond({.acceleration_bump = 5e-3}, Kind::acceleration, &vehicle::Limits::acceleration, 10.0);
  expect_millisecond({.rate_bump = 1e-3}, Kind::lateral_acceleration, &vehicle::Limits::lateral_acceleration,
                     2.002);
  expect_millisecond({.curvature_bump = 1e-3}, Kind::curvature, &vehicle::Limits::steering,
                     std::atan(0.4 * 0.5005));
  expect_millisecond({.curvature_bump = 1e-3}, Kind::steering_rate, &vehicle::Limits::steering_rate, 0.5);
}

TEST(Planted, ReverseSpeedHasItsOwnLimit) {
  const traj::TeamTrajectory plan{{straight({0, 0, 0}, 4.0, 4.0, -1)}};
  world::Scenario scenario = scenario_for(plan, car(), 100.0);
  scenario.models[0].limits.speed = 0.1;
  EXPECT_TRUE(judge(scenario, plan).holds) << summary(judge(scenario, plan));
  scenario.models[0].limits.reverse_speed = 1.5;
  expect_only(judge(scenario, plan), Kind::reverse_speed);
}

}  // namespace
}  // namespace seine::certify::test
