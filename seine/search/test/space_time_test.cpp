#include "seine/search/space_time_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/search/team_guess.hpp"
#include "seine/search/test/team_check.hpp"
#include "seine/world/check.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

using geom::Pose2;

constexpr double kTick = 0.05;  // s
constexpr double kTurn = 3.141592653589793;

geom::Convex disc(double radius) {
  return {{{0.0, 0.0}}, radius};
}

// At any time the body is inside the polygons of the tick, whatever the motion.
TEST(MovingBody, ContainsTheObstacleAtAnyTime) {
  Rng rng(20);
  for (int trial = 0; trial < effort(30, 6); ++trial) {
    SCOPED_TRACE(trial);
    const double pause = std::pow(10.0, rng.uniform(-4.0, 3.0));
    std::vector<world::Waypoint> motion;
    double t = rng.uniform(-1.0, 3.0);
    for (int i = 0; i < 6; ++i, t += pause * rng.uniform(0.1, 2.0))
      motion.push_back({t, {rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0), rng.uniform(-3.0, 3.0)}});
    const geom::Convex shape{{{-0.5, -0.2}, {0.5, -0.2}, {0.5, 0.2}}, 0.0};
    const MovingBody body(shape, motion, kTick);
    for (int probe = 0; probe < 100; ++probe) {
      const double at = rng.uniform(0.0, motion.back().t + 1.0);
      const geom::Convex there = geom::placed(shape, pose_at(motion, at));
      const int tick = static_cast<int>(std::floor(at / kTick + 0.5));
      for (const geom::Vec2 corner : there.core) {
        bool inside = false;
        for (std::size_t e = 0; e < body.events().size() && !inside; ++e) {
          const MovingBody::Event& event = body.events()[e];
          const std::vector<geom::Vec2> point{corner};
          inside = event.begin <= tick && tick < event.end &&
                   geom::distance(point, geom::convex_hull({body.polygon(static_cast<int>(e)).begin(),
                                                            body.polygon(static_cast<int>(e)).end()})) < 1e-6;
        }
        ASSERT_TRUE(inside) << "t " << at << " in a motion until " << motion.back().t;
      }
    }
  }
}

TEST(MovingBody, NeedsFewEventsForLongMotions) {
  for (const double end : {1e4, 1e6, 1e9, 1e13}) {
    const std::vector<world::Waypoint> motion{{0.0, {2.0, 2.0, 0.0}}, {end, {2.0, -2.0, 0.0}}};
    EXPECT_LT(MovingBody(disc(0.4), motion, kTick).events().size(), 200000u) << end;
    const std::vector<world::Waypoint> later{{end, {2.0, 2.0, 0.0}}, {end + 4.0, {2.0, -2.0, 0.0}}};
    EXPECT_LT(MovingBody(disc(0.4), later, kTick).events().size(), 1000u) << end;
  }
}

// What leaps is on the line between the two places for a moment, and nowhere else.
TEST(MovingBody, LeapsAlongALine) {
  const std::vector<world::Waypoint> motion{{2.0, {2.0, 5.0, 0.0}}, {2.000001, {2.0, -5.0, 0.0}}};
  const MovingBody body(disc(0.4), motion, kTick);
  EXPECT_LT(body.box().size().x, 2.5);
}

world::Scenario field(double half_width) {
  world::Scenario scenario;
  scenario.bounds = {{-12.0, -half_width}, {12.0, half_width}};
  scenario.models = {world::standard_car()};
  return scenario;
}

void add_disc(world::Scenario& scenario, double radius, std::vector<world::Waypoint> motion) {
  scenario.obstacles.push_back({"", world::Circle{{0.0, 0.0}, radius}});
  scenario.obstacles.back().motion = std::move(motion);
}

void add_block(world::Scenario& scenario, double x0, double y0, double x1, double y1) {
  scenario.obstacles.push_back({"", std::vector<geom::Vec2>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
}

double expect_guess(const world::Scenario& scenario) {
  const TeamGuess guess = guess_team(scenario, world::StaticMap(scenario), {});
  EXPECT_TRUE(guess.complete) << guess.reason;
  if (!guess.complete) return 0.0;
  TeamCheck(scenario, guess.robots).run();
  double latest = 0.0;
  for (const TimedPath& motion : guess.robots) latest = std::max(latest, motion.arrival());
  return latest;
}

TEST(SpaceTime, GoesRoundWhatStandsThoughItHasAMotion) {
  world::Scenario scenario = field(6.0);
  scenario.robots = {{"", 0, {-8.0, 0.0, 0.0}, 0.0, Pose2{8.0, 0.0, 0.0}}};
  add_disc(scenario, 0.4, {{0.0, {-6.0, 0.0, 0.0}}});
  add_disc(scenario, 0.4, {{1.0, {2.0, 0.1, 0.0}}, {9.0, {2.0, 0.1, 0.0}}});
  EXPECT_LT(expect_guess(scenario), 10.0);
}

TEST(SpaceTime, Overtakes) {
  Rng rng(21);
  for (int trial = 0; trial < effort(6, 2); ++trial) {
    SCOPED_TRACE(trial);
    world::Scenario scenario = field(6.0);
    scenario.robots = {{"", 0, {-8.0, 0.0, 0.0}, 0.0, Pose2{8.0, 0.0, 0.0}}};
    add_disc(scenario, rng.uniform(0.2, 0.6),
             {{0.0, {-6.0, rng.uniform(-0.1, 0.1), 0.0}},
              {rng.uniform(15.0, 40.0), {rng.uniform(2.0, 6.0), 0.0, 0.0}}});
    EXPECT_LT(expect_guess(scenario), 13.0);
  }
}

TEST(SpaceTime, DodgesAndReturns) {
  Rng rng(22);
  for (int trial = 0; trial < effort(6, 2); ++trial) {
    SCOPED_TRACE(trial);
    world::Scenario scenario = field(8.0);
    const double heading = rng.uniform(-kTurn, kTurn);
    scenario.robots = {{"",
                        0,
                        {0.0, 0.0, heading},
                        0.0,
                        Pose2{0.06 * std::cos(heading), 0.06 * std::sin(heading), heading}}};
    add_disc(scenario, 0.4, {{0.0, {-6.0, 0.0, 0.0}}, {6.0, {6.0, 0.0, 0.0}}});
    EXPECT_GT(expect_guess(scenario), 3.0);
  }
}

// A corridor between two rooms with a bay half way: someone makes way there, or waits in a room.
TEST(SpaceTime, TwoCarsPassInACorridorWithABay) {
  Rng rng(23);
  for (int trial = 0; trial < effort(4, 1); ++trial) {
    SCOPED_TRACE(trial);
    world::Scenario scenario = field(2.3);
    const double bay = rng.uniform(-1.0, 1.0), half = rng.uniform(0.28, 0.34);
    scenario.bounds = {{-5.0, -2.3}, {5.0, 2.3}};
    add_block(scenario, -3.0, -2.3, 3.0, -half);
    add_block(scenario, -3.0, half, bay - 1.1, 2.3);
    add_block(scenario, bay + 1.1, half, 3.0, 2.3);
    add_block(scenario, bay - 1.1, half + 0.8, bay + 1.1, 2.3);
    scenario.robots = {{"", 0, {-4.0, 0.0, 0.0}, 0.0, Pose2{4.0, 0.0, 0.0}},
                       {"", 0, {4.0, 0.0, kTurn}, 0.0, Pose2{-4.0, 0.0, kTurn}}};
    expect_guess(scenario);
  }
}

TEST(SpaceTime, TwoCarsSwapThroughADoor) {
  world::Scenario scenario = field(6.0);
  add_block(scenario, -0.5, -6.0, 0.5, -0.3);
  add_block(scenario, -0.5, 0.3, 0.5, 6.0);
  scenario.robots = {{"", 0, {-6.0, 0.0, 0.0}, 0.0, Pose2{6.0, 0.0, 0.0}},
                     {"", 0, {6.0, 0.0, kTurn}, 0.0, Pose2{-6.0, 0.0, kTurn}}};
  expect_guess(scenario);
}

TEST(SpaceTime, SaysWhatStandsOnTheGoalInTheEnd) {
  world::Scenario scenario = field(6.0);
  scenario.robots = {{"r1", 0, {-8.0, 0.0, 0.0}, 0.0, Pose2{8.0, 0.0, 0.0}}};
  add_disc(scenario, 0.4, {{0.0, {8.0, 5.0, 0.0}}, {6.0, {8.0, 0.0, 0.0}}});
  const std::vector<std::string> complaints = world::check(scenario, world::StaticMap(scenario));
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_EQ(complaints.front().find("the goal of r1 is blocked from t = 5."), 0u) << complaints.front();
  EXPECT_NE(complaints.front().find("s on by obstacle 1"), std::string::npos) << complaints.front();
}

}  // namespace
}  // namespace seine::search
