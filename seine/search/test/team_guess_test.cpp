#include "seine/search/team_guess.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "seine/search/retime.hpp"
#include "seine/search/test/team_check.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

using world::Family;

TeamGuess guess_of(const world::Scenario& scenario, const GuessOptions& options = {}) {
  return guess_team(scenario, world::StaticMap(scenario), options);
}

double makespan(const TeamGuess& guess) {
  double latest = 0.0;
  for (const TimedPath& motion : guess.robots) latest = std::max(latest, motion.arrival());
  return latest;
}

double mean_arrival(const TeamGuess& guess) {
  double sum = 0.0;
  for (const TimedPath& motion : guess.robots) sum += motion.arrival();
  return sum / static_cast<double>(guess.robots.size());
}

double mean_alone(const TeamGuess& guess) {
  return std::accumulate(guess.alone.begin(), guess.alone.end(), 0.0) /
         static_cast<double>(guess.alone.size());
}

void expect_same(const TeamGuess& a, const TeamGuess& b) {
  ASSERT_EQ(a.robots.size(), b.robots.size());
  for (std::size_t i = 0; i < a.robots.size(); ++i) {
    ASSERT_EQ(a.robots[i].profile.size(), b.robots[i].profile.size());
    for (std::size_t k = 0; k < a.robots[i].profile.size(); ++k) {
      EXPECT_EQ(a.robots[i].profile[k].t, b.robots[i].profile[k].t);
      EXPECT_EQ(a.robots[i].profile[k].s, b.robots[i].profile[k].s);
    }
  }
}

struct Task {
  Family family;
  int robots;
  std::uint64_t seeds;
  double mean_share;  // of the mean time alone, at most
};

class TeamFamilies : public testing::TestWithParam<Task> {};

TEST_P(TeamFamilies, AreCompleteSoundAndQuick) {
  double arrival = 0.0, alone = 0.0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << world::name_of(GetParam().family) << " seed " << seed);
    const world::Scenario scenario = world::generate(GetParam().family, GetParam().robots, seed);
    const TeamGuess guess = guess_of(scenario);
    ASSERT_TRUE(guess.complete) << guess.reason;
    TeamCheck(scenario, guess.robots).run();
    arrival += mean_arrival(guess);
    alone += mean_alone(guess);
  }
  EXPECT_LE(arrival, GetParam().mean_share * alone);
}

INSTANTIATE_TEST_SUITE_P(Guess, TeamFamilies,
                         testing::Values(Task{Family::random, 8, 6, 1.08}, Task{Family::random, 26, 3, 1.2},
                                         Task{Family::random, 50, 1, 1.15}, Task{Family::swap, 8, 2, 1.15},
                                         Task{Family::swap, 26, 1, 1.4}, Task{Family::corridor, 8, 2, 2.0},
                                         Task{Family::parking, 8, 2, 1.6}));

TEST(TeamGuess, SwapsFlowLikeARoundabout) {
  // Priority planning through the middle needs 7.7 s and 12.2 s, and each alone 5.2 s and 5.5 s.
  EXPECT_LE(makespan(guess_of(world::generate(Family::swap, 8, 0))), 6.0);
  EXPECT_LE(makespan(guess_of(world::generate(Family::swap, 26, 0))), 7.8);
}

TEST(TeamGuess, IsTheSameForAnyNumberOfThreads) {
  const world::Scenario scenario = world::generate(Family::random, 12, 3);
  expect_same(guess_of(scenario, {.threads = 1}), guess_of(scenario, {.threads = 4}));
}

TEST(TeamGuess, KeepsOffMovingObstacles) {
  world::Scenario scenario = world::generate(Family::swap, 6, 1);
  const std::vector<geom::Vec2> dented{{-0.6, -0.3}, {0.6, -0.3}, {0.6, 0.3}, {0.0, 0.1}, {-0.6, 0.3}};
  scenario.obstacles.push_back(
      {"ball", world::Circle{{0, 0}, 0.4}, 2.0, {{0.5, {-3, 0, 0}}, {4.0, {3, 0.5, 0}}, {5.0, {0, 3, 0}}}});
  scenario.obstacles.push_back(
      {"cart", dented, 2.0, {{0.0, {1.0, -3, 0.0}}, {3.0, {-1, 0, 2.0}}, {7.0, {1, -2, -2.0}}}});
  const TeamGuess guess = guess_of(scenario);
  ASSERT_TRUE(guess.complete) << guess.reason;
  TeamCheck(scenario, guess.robots).run();
}

TEST(TeamGuess, MixedTeamsWithOddFootprintsAndInfiniteLimits) {
  world::Scenario scenario = world::generate(Family::random, 12, 5);
  vehicle::Model pointed = scenario.models[0];
  pointed.name = "pointed";
  pointed.footprint = {{-0.1, -0.18}, {0.25, -0.2}, {0.5, 0.0}, {0.25, 0.2}, {-0.1, 0.18}};
  pointed.limits.speed = 1.6;
  pointed.limits.reverse_speed = 0.5;
  pointed.limits.lateral_acceleration = std::numeric_limits<double>::infinity();
  vehicle::Model slow = scenario.models[0];
  slow.name = "slow";
  slow.limits.speed = 0.8;
  slow.limits.acceleration = 0.7;
  scenario.models.push_back(pointed);
  scenario.models.push_back(slow);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) scenario.robots[i].model = static_cast<int>(i % 3);
  const TeamGuess guess = guess_of(scenario);
  ASSERT_TRUE(guess.complete) << guess.reason;
  TeamCheck(scenario, guess.robots).run();
}

TEST(TeamGuess, FixedRobotsKeepTheirMotion) {
  const world::Scenario scenario = world::generate(Family::random, 14, 2);
  const TeamGuess first = guess_of(scenario);
  ASSERT_TRUE(first.complete);
  std::vector<std::optional<TimedPath>> fixed(scenario.robots.size());
  for (std::size_t i = 0; i < fixed.size(); i += 2) fixed[i] = first.robots[i];
  std::vector<std::vector<TimedPath>> avoid(scenario.robots.size());
  for (std::size_t i = 1; i < fixed.size(); i += 2) avoid[i] = {first.robots[i]};
  const TeamGuess second = guess_of(scenario, {.seed = 7, .fixed = &fixed, .avoid = &avoid});
  ASSERT_TRUE(second.complete) << second.reason;
  TeamCheck(scenario, second.robots).run();
  bool changed = false;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i])
      EXPECT_EQ(second.robots[i].arrival(), first.robots[i].arrival());
    else
      changed = changed || std::abs(second.robots[i].path.length() - first.robots[i].path.length()) > 1e-3;
  }
  EXPECT_TRUE(changed);
}

TEST(TeamGuess, ExtraClearanceIsKeptWhereThereIsRoom) {
  const world::Scenario scenario = world::generate(Family::random, 8, 5);
  const TeamGuess guess = guess_of(scenario, {.extra_robot_clearance = 0.1});
  ASSERT_TRUE(guess.complete) << guess.reason;
  EXPECT_EQ(guess.extra_robot_clearance, 0.1);
  world::Scenario wider = scenario;  // starts and goals of this family are far enough apart
  wider.margins.robot += 0.1;
  TeamCheck(wider, guess.robots).run();
  // Two of these start nose to nose.
  const TeamGuess tight = guess_of(world::generate(Family::random, 8, 4), {.extra_robot_clearance = 0.15});
  EXPECT_TRUE(tight.complete);
  EXPECT_LE(tight.extra_robot_clearance, 0.15);
}

TEST(TeamGuess, SaysWhoHasNoWay) {
  world::Scenario scenario = world::generate(Family::random, 4, 0);
  const geom::Vec2 p = scenario.robots[2].goal->position();
  scenario.obstacles.push_back(
      {"lid", std::vector<geom::Vec2>{{p.x - 1, p.y - 1}, {p.x + 1, p.y - 1}, {p.x, p.y + 1}}, 1.0, {}});
  const TeamGuess guess = guess_of(scenario);
  EXPECT_FALSE(guess.complete);
  EXPECT_NE(guess.reason.find(scenario.robots[2].name), std::string::npos) << guess.reason;
}

TEST(Retime, GivenPathsGetNewTimesInAnyOrder) {
  const world::Scenario scenario = world::generate(Family::random, 14, 6);
  const TeamGuess guess = guess_of(scenario);
  ASSERT_TRUE(guess.complete);
  std::vector<Path> paths;
  std::vector<int> order;
  for (const TimedPath& motion : guess.robots) {
    paths.push_back(motion.path);
    order.insert(order.begin(), static_cast<int>(order.size()));
  }
  for (const std::vector<int>& wanted : {std::vector<int>{}, order}) {
    const auto motions = retime(scenario, paths, wanted);
    ASSERT_TRUE(motions.has_value());
    TeamCheck(scenario, *motions).run();
  }
}

}  // namespace
}  // namespace seine::search
