#include "seine/search/bottleneck.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/search/refusal.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

world::Obstacle wall(std::vector<Vec2> polygon) {
  return {.name = "wall", .shape = std::move(polygon), .motion = {}};
}

vehicle::Model car() {
  vehicle::Model model{
      .name = "default", .footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1), .limits = {}};
  model.limits.lateral_acceleration = 3.0;
  return model;
}

// A wall across the world with one opening, turned and moved anyhow.
TEST(Bottleneck, OfAnOpeningIsItsWidthAndItsPlace) {
  for (std::uint64_t seed = 1; seed <= std::uint64_t{effort(15, 3)}; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const double width = rng.uniform(0.05, 1.2), at = rng.uniform(-3.0, 3.0), thick = rng.uniform(0.05, 1.0);
    const geom::Pose2 turn{rng.uniform(-0.5, 0.5), 0.0, rng.uniform(-0.5, 0.5)};
    world::Scenario scenario;
    scenario.bounds = {{-8, -8}, {8, 8}};
    for (auto side : {box(-0.5 * thick, -30, 0.5 * thick, at - 0.5 * width),
                      box(-0.5 * thick, at + 0.5 * width, 0.5 * thick, 30)}) {
      for (Vec2& p : side) p = turn * p;
      scenario.obstacles.push_back(wall(side));
    }
    const world::StaticMap map(scenario);
    const auto found = bottleneck(map, {-6, rng.uniform(-4, 4)}, {6, rng.uniform(-4, 4)}, 0.08, 0.0, 1.0);
    ASSERT_TRUE(found);
    EXPECT_GE(found->upper_width, width);
    EXPECT_NEAR(found->width, width, 0.01 + 0.02 * width);
    const Vec2 local = {geom::dot(found->at - turn.position(), turn.direction()),
                        geom::cross(turn.direction(), found->at - turn.position())};
    EXPECT_LE(std::abs(local.x), 0.5 * thick + 0.15);
    EXPECT_NEAR(local.y, at, 0.05);
  }
}

// Among random discs a way that is known bounds the answer from below.
TEST(Bottleneck, NeverProvesLessThanAWayThatIsThere) {
  for (std::uint64_t seed = 1; seed <= std::uint64_t{effort(15, 3)}; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    world::Scenario scenario;
    scenario.bounds = {{-5, -5}, {5, 5}};
    for (int i = 0; i < 25; ++i) {
      scenario.obstacles.push_back(
          {.name = "disc",
           .shape = world::Circle{{rng.uniform(-4, 4), rng.uniform(-5, 5)}, rng.uniform(0.1, 0.6)},
           .motion = {}});
    }
    const world::StaticMap map(scenario);
    // The best of many polylines from left to right.
    double known = -1.0;
    for (int tries = 0; tries < 300; ++tries) {
      Vec2 from{-4.8, 0.0};
      double least = 10.0;
      for (int leg = 0; leg < 5 && least > known; ++leg) {
        const Vec2 to = leg == 4 ? Vec2{4.8, 0.0} : Vec2{-2.9 + 1.9 * leg, rng.uniform(-4.5, 4.5)};
        for (int i = 0; i <= 60 && least > known; ++i) {
          const std::array<Vec2, 1> p{from + (i / 60.0) * (to - from)};
          least = std::min(least, map.distance(p, 10.0));
        }
        from = to;
      }
      known = std::max(known, least);
    }
    const auto found = bottleneck(map, {-4.8, 0}, {4.8, 0}, 0.05, 0.0, 3.0);
    ASSERT_TRUE(found);
    EXPECT_GE(found->upper_width, 2.0 * known - 0.2);  // samples of a polyline are up to 0.1 m apart
    EXPECT_GE(found->upper_width, found->width);
  }
}

world::Scenario closed_in(double opening, bool start) {
  world::Scenario scenario;
  scenario.bounds = {{-20, -20}, {20, 20}};
  scenario.models = {car()};
  scenario.obstacles = {wall(box(1, -2, 4, -1.9)), wall(box(1, 1.9, 4, 2)), wall(box(3.9, -2, 4, 2)),
                        wall(box(1, -2, 1.1, -0.5 * opening)), wall(box(1, 0.5 * opening, 1.1, 2))};
  geom::Pose2 in{2.5, 0, 0}, out{-3, 0, 0};
  scenario.robots = {{.name = "car0", .start = start ? in : out, .goal = start ? out : in}};
  return scenario;
}

TEST(Refusal, SaysWhichEndIsClosedInAndWhere) {
  for (const bool start : {false, true}) {
    const world::Scenario scenario = closed_in(0.45, start);
    const world::StaticMap map(scenario);
    const Refusal refusal = why_no_way(scenario, map, 0);
    EXPECT_EQ(refusal.cause, start ? Refusal::Cause::start_closed_in : Refusal::Cause::goal_closed_in);
    ASSERT_TRUE(refusal.place);
    EXPECT_NEAR(refusal.place->width, 0.45, 0.02);
    EXPECT_NEAR(refusal.place->at.x, 1.05, 0.2);
    EXPECT_NEAR(refusal.place->at.y, 0.0, 0.03);
    const std::string text = sentence(refusal, scenario, 0);
    EXPECT_NE(text.find("proved unreachable"), std::string::npos) << text;
    EXPECT_NE(text.find("0.5 m is needed"), std::string::npos) << text;
  }
}

TEST(Refusal, ProvesNothingWhereTheCarFits) {
  for (const double opening : {0.5, 0.51, 0.6, 1.0}) {
    const world::Scenario scenario = closed_in(opening, false);
    EXPECT_EQ(why_no_way(scenario, world::StaticMap(scenario), 0).cause, Refusal::Cause::no_room_found);
  }
}

TEST(Refusal, OfABoxWithoutOpeningSaysSo) {
  const world::Scenario scenario = closed_in(0.0, false);
  const Refusal refusal = why_no_way(scenario, world::StaticMap(scenario), 0);
  EXPECT_EQ(refusal.cause, Refusal::Cause::goal_closed_in);
  EXPECT_NE(sentence(refusal, scenario, 0).find("without any opening"), std::string::npos);
}

}  // namespace
}  // namespace seine::search
