// Plans built to deceive the certificate: none that it accepts may be wrong by the look at the documented
// formula (bench/deceive). And the look itself must find what is planted.
#include <gtest/gtest.h>

#include "bench/deceive/mutants.hpp"
#include "bench/deceive/search.hpp"
#include "seine/base/effort.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace seine::deceive {
namespace {

/// A car that drives 3 m ahead from rest to rest in 4 s, its wheel straight.
Case honest() {
  traj::Segment segment;
  segment.curve = {along({}, {1.0, 0.0}, linear(0.0, 3.0))};
  segment.progress = {ramp(0.0, 1.0)};
  segment.piece_duration = 4.0;
  return case_of("honest", car(0.6), {{{{segment}}}});
}

bool finds(const Case& made, const std::string& what) {
  for (const Fault& fault : look_at(made.scenario, made.plan))
    if (fault.ratio > 1.0 && std::string(fault.what).find(what) != std::string::npos) return true;
  return false;
}

TEST(Look, FindsNothingInAnHonestPlan) {
  const Case made = honest();
  const auto faults = look_at(made.scenario, made.plan);
  EXPECT_LE(worst_ratio(faults), 1.0) << describe(faults);
  EXPECT_TRUE(judge(made, {}).accepted);
}

TEST(Look, FindsWhatIsPlanted) {
  Case made = honest();
  made.scenario.models[0].limits.speed = 1.4;  // 15/8 · 3 m / 4 s = 1.40625 m/s
  EXPECT_TRUE(finds(made, "speed (m/s)"));
  made = honest();
  made.scenario.models[0].limits.acceleration = 1.08;  // 10/√3 · 3 m / 16 s² = 1.0825 m/s²
  EXPECT_TRUE(finds(made, "acceleration"));
  made = honest();
  made.scenario.obstacles.push_back({.name = "post", .shape = world::Circle{{1.5, 0.3}, 0.101}});
  EXPECT_TRUE(finds(made, "with what stands"));
  made = honest();
  made.scenario.robots[0].goal->x += 2e-4;
  EXPECT_TRUE(finds(made, "goal (m)"));
  made = honest();
  made.plan.robots[0].segments[0].progress[0][0] -= 1e-3;
  EXPECT_TRUE(finds(made, "start (m)"));
  made = honest();
  made.plan.robots[0].segments[0].curve[0][1][3] = 100.0;  // y = 100 u³
  EXPECT_TRUE(finds(made, "curvature"));
  made.scenario.models[0].limits.steering = 1.5;
  made.scenario.models[0].limits.steering_rate = 0.3;
  EXPECT_TRUE(finds(made, "steering rate"));
}

TEST(Look, AddsJumpsUp) {
  Case made = honest();
  traj::Segment& segment = made.plan.robots[0].segments[0];
  segment.progress = {{ramp(0.0, 0.5)}};
  segment.piece_duration = 0.05;
  for (int i = 1; i <= 40; ++i) segment.progress.push_back(constant(0.5 + i * 1e-6));  // 3e-6 m each
  segment.progress.push_back(ramp(0.5 + 4e-5, 1.0));
  EXPECT_TRUE(finds(made, "jumps of the position in all"));
}

TEST(Look, SeesTheNetStretch) {
  // Three cars on a ring 1.8 m wide hold a net whose sides are 2 m; the third leaves.
  std::vector<traj::RobotTrajectory> ways;
  Case made = honest();
  net::Net net{.rest = {{0.0, 0.0}, {2.0, 0.0}, {1.0, 1.7}},
               .attachments = {{{0.0, 0.0}}, {{0.0, 0.0}}, {{0.0, 0.0}}}};
  for (const geom::Vec2 at : {geom::Vec2{0.0, 0.0}, {1.8, 0.0}, {0.9, 1.5}}) {
    traj::Segment segment = made.plan.robots[0].segments[0];
    segment.curve = {along(at, {1.0, 0.0}, linear(0.0, at.y > 1.0 ? 3.0 : 0.1))};
    ways.push_back({{segment}});
  }
  made = case_of("net", car(0.6), {ways});
  made.scenario.net = net;
  EXPECT_TRUE(finds(made, "too far apart"));
}

class Deceive : public testing::TestWithParam<std::size_t> {};

TEST_P(Deceive, NothingWrongIsAccepted) {
  const Construction construction = constructions()[GetParam()];
  constexpr int kSteps = 12;
  for (int trial = 0; trial < effort(2, 1); ++trial) {
    const std::uint64_t seed = 1000 * GetParam() + static_cast<std::uint64_t>(trial);
    Rng rng(seed);
    const Attack attack = attack_by(construction, rng, effort(kSteps, 4));
    EXPECT_FALSE(attack.deceived()) << construction.name << " with seed " << seed << "\n"
                                    << describe(attack.verdict.faults);
  }
}

INSTANTIATE_TEST_SUITE_P(Constructions, Deceive, testing::Range<std::size_t>(0, constructions().size()),
                         [](const auto& of) { return std::string(constructions()[of.param].name); });

TEST(Mutants, OfACertifiedPlan) {
  const world::Family families[] = {world::Family::random, world::Family::corridor, world::Family::parking};
  for (int trial = 0; trial < effort(3, 1); ++trial) {
    Case made{.name = "mutant", .scenario = world::generate(families[trial], 2, 7), .plan = {}};
    const planner::PlanResult result = planner::plan(made.scenario, {.threads = 1});
    ASSERT_TRUE(result.certified) << result.reason;
    made.plan = result.plan;
    const Verdict honest = judge(made, {});
    EXPECT_TRUE(honest.accepted);
    EXPECT_LE(honest.ratio, 1.0) << describe(honest.faults);
    Rng rng(static_cast<std::uint64_t>(trial));
    const Attack attack = attack_from(made, rng, effort(60, 6));
    EXPECT_GT(attack.accepted, 0) << "trial " << trial;
    EXPECT_FALSE(attack.deceived()) << "trial " << trial << "\n" << describe(attack.verdict.faults);
  }
}

}  // namespace
}  // namespace seine::deceive
