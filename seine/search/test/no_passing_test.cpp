#include "seine/search/no_passing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/vehicle/catalogue.hpp"

namespace seine::search {
namespace {

constexpr std::size_t kPairs = 4'000'000;

world::Obstacle block(double x0, double y0, double x1, double y1) {
  world::Obstacle obstacle;
  obstacle.shape = std::vector<geom::Vec2>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return obstacle;
}

// A dead-end lane, 10 m long: two of the project's cars (0.6 m × 0.4 m) want to change places.
world::Scenario lane(double half_width) {
  world::Scenario scenario;
  scenario.bounds = {{-5.0, -half_width}, {5.0, half_width}};
  scenario.models = {*vehicle::catalogued("letter")};
  world::Robot robot;
  robot.name = "a", robot.start = {-3.0, 0.0, 0.0}, robot.goal = geom::Pose2{3.0, 0.0, 0.0};
  scenario.robots.push_back(robot);
  robot.name = "b", robot.start = {3.0, 0.0, 0.0}, robot.goal = geom::Pose2{-3.0, 0.0, 0.0};
  scenario.robots.push_back(robot);
  return scenario;
}

TEST(NoPassing, IsProvedInALaneWithoutABay) {
  const world::Scenario scenario = lane(0.3);
  EXPECT_TRUE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, kPairs));
  EXPECT_TRUE(cannot_both_arrive(scenario, world::StaticMap(scenario), 1, 0, kPairs));
}

TEST(NoPassing, IsNotClaimedWhereTheyPassBarely) {
  // Two widths and three margins of 0.05 m, and a centimetre.
  const world::Scenario scenario = lane(0.48);
  EXPECT_FALSE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, kPairs));
}

TEST(NoPassing, IsNotClaimedForCarsThatFollowEachOther) {
  world::Scenario scenario = lane(0.3);
  scenario.robots[0].goal = geom::Pose2{1.0, 0.0, 0.0};
  scenario.robots[1].goal = geom::Pose2{4.0, 0.0, 0.0};
  EXPECT_FALSE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, kPairs));
}

TEST(NoPassing, IsNotClaimedWithABay) {
  world::Scenario scenario = lane(0.3);
  scenario.bounds = {{-5.0, -0.3}, {5.0, 1.0}};
  scenario.obstacles = {block(-5.0, 0.3, -1.0, 1.0), block(1.0, 0.3, 5.0, 1.0)};
  EXPECT_FALSE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, kPairs));
}

TEST(NoPassing, IsProvedForADeadEndThatTheOtherStandsIn) {
  // b stands in the middle of a dead end and may not leave it on the other side.
  world::Scenario scenario = lane(0.3);
  scenario.robots[1].start = {0.0, 0.0, 0.0};
  scenario.robots[1].goal = geom::Pose2{0.0, 0.0, 0.0};
  EXPECT_TRUE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, kPairs));
}

TEST(NoPassing, GivesUpWhereThereIsTooMuchGround) {
  const world::Scenario scenario = lane(0.3);
  EXPECT_FALSE(cannot_both_arrive(scenario, world::StaticMap(scenario), 0, 1, 100));
}

// Whether two discs that contain the cars in any heading get through on a grid of points, one step of one of
// them at a time: a motion that exists for certain, at least for cars that could drive in any direction.
bool discs_pass(const world::Scenario& scenario, const world::StaticMap& map, double radius, double step) {
  const geom::Box& box = scenario.bounds;
  const int columns = static_cast<int>(box.size().x / step) + 1,
            rows = static_cast<int>(box.size().y / step) + 1;
  const auto point = [&](int k) {
    return box.low + step * geom::Vec2{1.0 * (k % columns), 1.0 * (k / columns)};
  };
  const auto nearest = [&](const geom::Vec2& p) {
    return static_cast<int>(std::lround((p.x - box.low.x) / step)) +
           columns * static_cast<int>(std::lround((p.y - box.low.y) / step));
  };
  const double half = 0.5 * step;  // what lies between two points
  std::vector<char> free(static_cast<std::size_t>(columns * rows));
  for (int k = 0; k < columns * rows; ++k) {
    const std::array<geom::Vec2, 1> at{point(k)};
    free[static_cast<std::size_t>(k)] =
        map.distance(at, 2.0) >= radius + scenario.margins.obstacle + half ? 1 : 0;
  }
  using Pair = std::pair<int, int>;
  const Pair from{nearest(scenario.robots[0].start.position()), nearest(scenario.robots[1].start.position())};
  const Pair to{nearest(scenario.robots[0].goal->position()), nearest(scenario.robots[1].goal->position())};
  const auto allowed = [&](const Pair& pair) {
    return free[static_cast<std::size_t>(pair.first)] && free[static_cast<std::size_t>(pair.second)] &&
           geom::norm(point(pair.first) - point(pair.second)) >= 2.0 * radius + scenario.margins.robot + half;
  };
  if (!allowed(from) || !allowed(to)) return false;
  std::vector<char> known(free.size() * free.size());
  const auto is_new = [&](const Pair& pair) {
    char& mark =
        known[static_cast<std::size_t>(pair.first) * free.size() + static_cast<std::size_t>(pair.second)];
    return std::exchange(mark, 1) == 0;
  };
  std::vector<Pair> open{from};
  while (!open.empty()) {
    const Pair at = open.back();
    open.pop_back();
    if (at == to) return true;
    for (const int way : {1, -1, columns, -columns}) {
      const auto beside = [&](int k) {
        const bool wraps = (way == 1 && k % columns == columns - 1) || (way == -1 && k % columns == 0);
        const int next = k + way;
        return wraps || next < 0 || next >= columns * rows ? k : next;
      };
      for (const Pair& next : {Pair{beside(at.first), at.second}, Pair{at.first, beside(at.second)}})
        if (allowed(next) && is_new(next)) open.push_back(next);
    }
  }
  return false;
}

// Random blocks in a small yard; short cars, nearly discs, so that both answers come up.
TEST(NoPassing, IsNeverClaimedWhereTwoDiscsPass) {
  constexpr std::uint64_t kSeed = 20261128;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Rng rng(kSeed);
  int pass = 0, proved = 0, tried = 0;
  const double radius = 0.2;
  for (int trial = 0; trial < effort(150, 15); ++trial) {
    world::Scenario scenario;
    scenario.bounds = {{0.0, 0.0}, {2.2, 1.4}};
    vehicle::Model model = *vehicle::catalogued("letter");
    model.footprint.clear();
    for (int k = 0; k < 8; ++k) {
      const double angle = 2.0 * 3.14159265358979 * (k + 0.5) / 8.0;
      model.footprint.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    scenario.models = {model};
    scenario.margins.robot = scenario.margins.obstacle = rng.uniform(0.0, 0.05);
    const int blocks = 1 + rng.below(4);
    for (int k = 0; k < blocks; ++k) {
      const double x = rng.uniform(0.0, 1.8), y = rng.uniform(0.0, 1.0);
      scenario.obstacles.push_back(block(x, y, x + rng.uniform(0.1, 0.8), y + rng.uniform(0.1, 0.8)));
    }
    const world::StaticMap map(scenario);
    // On points of the grid, so that the two searches ask the same; most of them free.
    const double step = 0.1;
    const auto place = [&] {
      geom::Pose2 pose{};
      for (int attempt = 0; attempt < 50; ++attempt) {
        pose = {step * (1 + rng.below(20)), step * (1 + rng.below(12)), 0.0};
        const std::array<geom::Vec2, 1> at{pose.position()};
        if (map.distance(at, 2.0) > radius + scenario.margins.obstacle + 0.5 * step) break;
      }
      return pose;
    };
    for (int k = 0; k < 2; ++k) {
      world::Robot robot;
      robot.name = k == 0 ? "a" : "b";
      robot.start = place(), robot.goal = place();
      scenario.robots.push_back(robot);
    }
    const bool claimed = cannot_both_arrive(scenario, map, 0, 1, kPairs);
    const bool passes = discs_pass(scenario, map, radius, step);
    ++tried, pass += passes ? 1 : 0, proved += claimed ? 1 : 0;
    EXPECT_FALSE(claimed && passes) << "trial " << trial;
  }
  EXPECT_GT(pass, effort(10, 0));
  EXPECT_GT(proved, effort(10, 0));
  RecordProperty("pass", pass), RecordProperty("proved", proved);
}

}  // namespace
}  // namespace seine::search
