// Cars that stand where they should, and moves of next to nothing: through the planner, the plan file, the
// certificate, the exports, the picture and the simulation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/baseline/letter/letter.hpp"
#include "seine/certify/certificate.hpp"
#include "seine/drive/tracking.hpp"
#include "seine/io/export.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/svg.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/static_map.hpp"

namespace seine {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Where the goal lies, seen from the start.
struct Move {
  const char* name;
  geom::Pose2 by;
  double longest;  ///< s, what a plan may take; 0: the car stays
};

const std::vector<Move>& moves() {
  static const std::vector<Move> all{{"nothing", {0, 0, 0}, 0.0},
                                     {"1e-12 ahead", {1e-12, 0, 0}, 0.0},
                                     {"1 um beside", {0, 1e-6, 0}, 0.0},
                                     {"50 um behind", {-5e-5, 0, 0}, 0.0},
                                     {"turned by 1e-6", {0, 0, 1e-6}, 0.0},
                                     {"200 um ahead", {2e-4, 0, 0}, 0.3},
                                     {"1 mm ahead", {1e-3, 0, 0}, 0.5},
                                     {"1 mm behind", {-1e-3, 0, 0}, 0.5},
                                     {"1 cm ahead, 10 um aside", {1e-2, 1e-5, -1e-5}, 0.6},
                                     {"1 cm behind", {-1e-2, 0, 0}, 0.6},
                                     {"1 mm beside", {0, -1e-3, 0}, 2.5},
                                     {"1 cm beside", {0, 1e-2, 0}, 3.0},
                                     {"turned by 1e-3", {0, 0, 1e-3}, 2.5},
                                     {"turned by a degree", {0, 0, kDegree}, 2.5},
                                     {"turned by ten degrees", {0, 0, -10.0 * kDegree}, 3.0},
                                     {"3 mm ahead, 2 mm beside, turned", {3e-3, 2e-3, 0.01}, 2.5}};
  return all;
}

vehicle::Model car(bool forward_only = false) {
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
  if (forward_only) model.limits.reverse_speed = 0.0;
  return model;
}

world::Robot robot(const std::string& name, const geom::Pose2& start, const geom::Pose2& by) {
  const geom::Vec2 at = start * by.position();
  return {.name = name, .start = start, .goal = geom::Pose2{at.x, at.y, start.heading + by.heading}};
}

world::Scenario empty_world(const vehicle::Model& model) {
  world::Scenario scenario;
  scenario.name = "short moves";
  scenario.bounds = {{-10, -10}, {10, 10}};
  scenario.models = {model};
  return scenario;
}

/// Every user of a plan has its turn.
void use(const world::Scenario& scenario, const planner::PlanResult& result) {
  const std::string text = io::plan_text(scenario, result);
  const io::PlanFile read = io::parse_plan(text, "plan.json");
  const certify::Certificate again = certify::certify(scenario, world::StaticMap(scenario), read.plan);
  EXPECT_TRUE(again.holds) << again.violations.front().text;
  EXPECT_EQ(read.plan.makespan(), result.plan.makespan());

  EXPECT_NE(io::states_csv(scenario, read.plan, 10.0).find("\nmover,0,"), std::string::npos);
  EXPECT_FALSE(io::states_tum(read.plan.robots.front(), read.plan.makespan(), 10.0).empty());
  EXPECT_FALSE(io::clmapf_schedule(scenario, read.plan, 1.0).empty());
  const std::string picture = io::svg_text(scenario, &read.plan);
  EXPECT_EQ(picture.find("nan"), std::string::npos);

  const sim::SimulationOptions options{.noise = sim::noise_named("none")};
  const sim::SimulationResult driven =
      sim::simulate(scenario, read.plan,
                    drive::tracking_controller(scenario, drive::tracking_options(options.noise)), options);
  EXPECT_TRUE(driven.delivered);
  EXPECT_LT(driven.goal_error, 0.02);
}

void expect_plan(const world::Scenario& scenario, const Move& move) {
  SCOPED_TRACE(move.name);
  const planner::PlanResult result = planner::plan(scenario, {.threads = 1});
  ASSERT_TRUE(result.certified) << result.reason;
  const traj::RobotTrajectory& way = result.plan.robots.front();
  EXPECT_LE(way.arrival(), move.longest);
  if (move.longest == 0.0) {
    EXPECT_TRUE(way.stands.has_value());
  }
  use(scenario, result);
}

TEST(ShortMoves, OfOneCar) {
  constexpr std::uint64_t kSeed = 11;
  Rng rng(kSeed);
  for (const Move& move : moves()) {
    world::Scenario scenario = empty_world(car());
    const geom::Pose2 start{rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-3, 3)};
    scenario.robots = {robot("mover", start, move.by)};
    expect_plan(scenario, move);
  }
}

TEST(ShortMoves, OfACarWithoutReverseGear) {
  for (const Move& move : moves()) {
    if (move.longest > 0.0 && (move.by.x <= 0.0 || std::abs(move.by.y) > 5e-5)) continue;
    world::Scenario scenario = empty_world(car(true));
    scenario.robots = {robot("mover", {1, 2, 0.7}, move.by)};
    expect_plan(scenario, move);
  }
}

TEST(ShortMoves, BesideAWall) {
  for (const Move& move : moves()) {
    world::Scenario scenario = empty_world(car());
    // As near as the margin and the move allow.
    const double gap = scenario.margins.obstacle + 0.02;
    scenario.obstacles.push_back(
        {.name = "wall", .shape = std::vector<geom::Vec2>{{-3, 0.2 + gap}, {3, 0.2 + gap}, {3, 1}, {-3, 1}}});
    scenario.robots = {robot("mover", {0, 0, 0}, move.by)};
    SCOPED_TRACE(move.name);
    const planner::PlanResult result = planner::plan(scenario, {.threads = 1});
    // Turning on the spot by degrees takes more room than there is.
    if (move.longest <= 0.6) {
      EXPECT_TRUE(result.certified) << result.reason;
    }
    if (result.certified) use(scenario, result);
  }
}

TEST(ShortMoves, InATeamOfWhichOneStandsAndOnePasses) {
  for (const Move& move : moves()) {
    world::Scenario scenario = empty_world(car());
    scenario.robots = {robot("mover", {0, 3, 0.2}, move.by), robot("stander", {0, 0, 0}, {}),
                       robot("passer", {-4, 0.1, 0}, {8, 0, 0})};
    expect_plan(scenario, move);
  }
}

TEST(ShortMoves, ATeamThatStands) {
  world::Scenario scenario = empty_world(car());
  for (int k = 0; k < 6; ++k)
    scenario.robots.push_back(robot(k == 0 ? "mover" : "r" + std::to_string(k), {1.5 * k - 4.0, 0, 0.3}, {}));
  const planner::PlanResult result = planner::plan(scenario, {.threads = 2});
  ASSERT_TRUE(result.certified) << result.reason;
  EXPECT_EQ(result.plan.makespan(), 0.0);
  EXPECT_NEAR(result.certificate.robots.clearance, 0.9, 0.1);
  use(scenario, result);
}

TEST(ShortMoves, ACarThatStandsIsJudged) {
  world::Scenario scenario = empty_world(car());
  scenario.robots = {robot("mover", {0, 0, 0}, {}), robot("other", {2, 0, 0}, {})};
  const auto judge = [&](const geom::Pose2& a, const geom::Pose2& b) {
    const traj::TeamTrajectory plan{{traj::RobotTrajectory::standing(a), traj::RobotTrajectory::standing(b)}};
    return certify::certify(scenario, world::StaticMap(scenario), plan);
  };
  EXPECT_TRUE(judge({0, 0, 0}, {2, 0, 0}).holds);
  EXPECT_FALSE(judge({2e-4, 0, 0}, {2, 0, 0}).holds);
  EXPECT_FALSE(judge({0, 0, 2e-4}, {2, 0, 0}).holds);
  scenario.robots[1] = robot("other", {0.62, 0, 0}, {});
  EXPECT_FALSE(judge({0, 0, 0}, {0.62, 0, 0}).holds);
  scenario.robots[1] = robot("other", {2, 0, 0}, {});
  scenario.robots[0].start_speed = 0.5;
  EXPECT_FALSE(judge({0, 0, 0}, {2, 0, 0}).holds);
  scenario.robots[0].start_speed = 0.0;
  // Something that comes by later is looked at for as long as it moves.
  scenario.obstacles.push_back({.name = "cart",
                                .shape = world::Circle{{0, 0}, 0.2},
                                .motion = {{0.0, {-5, 0, 0}}, {10.0, {5, 0, 0}}}});
  EXPECT_FALSE(judge({0, 0, 0}, {2, 0, 0}).holds);
}

TEST(ShortMoves, ACarThatMovesAtItsGoalComesBack) {
  for (const double speed : {0.3, -0.3, 1.5}) {
    world::Scenario scenario = empty_world(car());
    scenario.robots = {robot("mover", {0, 0, 0}, {})};
    scenario.robots[0].start_speed = speed;
    const planner::PlanResult result = planner::plan(scenario, {.threads = 1});
    ASSERT_TRUE(result.certified) << speed << ": " << result.reason;
    EXPECT_LT(result.plan.makespan(), 4.0);
    use(scenario, result);
  }
}

// The letter's cars cannot start from rest, so what it claims for a short move does not hold; it must answer.
TEST(ShortMoves, ByTheLettersMethod) {
  for (const Move& move : moves()) {
    SCOPED_TRACE(move.name);
    world::Scenario scenario = empty_world(car());
    scenario.robots = {robot("mover", {0, 3, 0.2}, move.by), robot("stander", {0, 0, 0}, {}),
                       robot("passer", {-4, 0.1, 0}, {8, 0, 0})};
    for (const std::size_t cars : {3U, 2U}) {
      scenario.robots.resize(cars);
      const planner::PlanResult result = baseline::letter::plan(scenario, {.threads = 1}, {});
      ASSERT_EQ(result.plan.robots.size(), cars) << result.reason;
      EXPECT_EQ(result.certified, cars == 2 && move.longest == 0.0) << result.reason;
      EXPECT_TRUE(result.plan.robots[1].stands.has_value());
    }
  }
}

}  // namespace
}  // namespace seine
