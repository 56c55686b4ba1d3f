#include "seine/search/motion.hpp"

#include <gtest/gtest.h>

#include <queue>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/geom/convex.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/search/route.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

constexpr std::uint64_t kSeed = 11;

struct Scene {
  explicit Scene(std::uint64_t seed)
      : scenario(world::generate(world::Family::random, 8, seed)), map(scenario), distances(map, 0.14, 0.9) {}
  const vehicle::Model& car() const { return scenario.models[0]; }
  geom::Vec2 somewhere(Rng& rng) const {
    return {rng.uniform(scenario.bounds.low.x, scenario.bounds.high.x),
            rng.uniform(scenario.bounds.low.y, scenario.bounds.high.y)};
  }
  world::Scenario scenario;
  world::StaticMap map;
  PointDistances distances;
};

double exact_distance(const Scene& scene, const geom::Pose2& pose) {
  return scene.map.nearest(geom::placed({scene.car().footprint}, pose).core, 0.9).distance;
}

TEST(DiscCover, CoversTheFootprintAndStaysInside) {
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  for (const auto& footprint :
       {vehicle::rectangle_footprint(0.6, 0.4, 0.1), vehicle::rectangle_footprint(4.7, 1.9, 0.9),
        std::vector<geom::Vec2>{{-0.2, -0.2}, {0.4, -0.1}, {0.6, 0.1}, {-0.2, 0.3}}}) {
    const DiscCover cover(footprint);
    const geom::Box box = geom::bounding_box(footprint);
    for (int i = 0; i < 2000; ++i) {
      const geom::Vec2 p{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
      const bool inside = geom::distance(std::span(&p, 1), footprint) <= 0.0;
      bool covered = false, in_inner = false;
      for (const auto& disc : cover.discs) {
        const double distance = geom::norm(p - geom::Vec2{disc.x, cover.axis});
        covered = covered || distance <= disc.outer + 1e-12;
        in_inner = in_inner || distance < disc.inner - 1e-12;
      }
      EXPECT_TRUE(covered || !inside);
      EXPECT_TRUE(inside || !in_inner);
    }
  }
}

TEST(PointDistances, BoundsHold) {
  SCOPED_TRACE(kSeed);
  const Scene scene(kSeed);
  Rng rng(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const geom::Vec2 p = scene.somewhere(rng);
    const auto bounds = scene.distances.bounds(p);
    const double distance = scene.map.nearest(std::span(&p, 1), 5.0).distance;
    EXPECT_LE(bounds.lower, distance);
    EXPECT_GE(bounds.upper, distance);
  }
  EXPECT_LT(scene.distances.bounds({-100, 0}).upper, 0.0);
}

TEST(FootprintChecker, RoomIsALowerBoundWithTheRightSign) {
  SCOPED_TRACE(kSeed);
  const Scene scene(kSeed);
  Rng rng(kSeed);
  FootprintChecker quick(scene.map, &scene.distances, scene.car(), 0.05),
      plain(scene.map, nullptr, scene.car(), 0.05);
  quick.set_slack(0.015);
  for (int i = 0; i < 20000; ++i) {
    const geom::Vec2 p = scene.somewhere(rng);
    const geom::Pose2 pose{p.x, p.y, rng.uniform(-3.1, 3.1)};
    const double room = exact_distance(scene, pose) - 0.05;
    EXPECT_EQ(quick.room(pose) >= 0.0, room >= 0.0);
    EXPECT_EQ(quick.clear(pose), room >= 0.015);
    EXPECT_LE(quick.room(pose), std::max(room, 0.0) + 1e-9);
    EXPECT_EQ(plain.room(pose) >= 0.0, room >= 0.0);
  }
}

/// What a sweep calls clear is clear at every millimetre; what it refuses is nearer than the slack somewhere.
TEST(FootprintChecker, SweepsAgreeWithDenseLooking) {
  SCOPED_TRACE(kSeed);
  const Scene scene(kSeed);
  Rng rng(kSeed);
  for (const double slack : {0.0, 0.015}) {
    FootprintChecker checker(scene.map, &scene.distances, scene.car(), 0.05);
    checker.set_slack(slack);
    int clear = 0, blocked = 0;
    const int wanted = effort(300, 50);
    while (clear < wanted || blocked < wanted) {
      const geom::Vec2 p = scene.somewhere(rng);
      const geom::Pose2 from{p.x, p.y, rng.uniform(-3.1, 3.1)};
      if (!checker.clear(from)) continue;
      const vehicle::Arc arc{rng.uniform(-2, 2), rng.uniform(-2, 2)};
      double smallest = 9.0;
      for (double t = 0.0; t <= 1.0; t += 0.0005) {
        smallest = std::min(
            smallest, exact_distance(scene, vehicle::drive(from, arc.curvature, t * arc.distance)) - 0.05);
      }
      if (checker.clear(from, arc)) {
        ++clear;
        EXPECT_GE(smallest, slack > 0.0 ? 0.0 : -1e-4);
      } else {
        ++blocked;
        EXPECT_LT(smallest, slack + 1e-3);
      }
    }
  }
}

TEST(CostToGo, IsDijkstraInAnyOrderOfQuestions) {
  SCOPED_TRACE(kSeed);
  const Scene scene(kSeed);
  Rng rng(kSeed);
  const geom::Vec2 goal = scene.scenario.robots[0].goal->position();
  CostToGo all({&scene.distances, 0.25}, goal);
  // One that is asked corner to corner sees everything; another is asked at random with changing focus.
  CostToGo some({&scene.distances, 0.25}, goal);
  for (int i = 0; i < 500; ++i) {
    const geom::Vec2 p = scene.somewhere(rng);
    if (i % 50 == 0) some.focus(scene.somewhere(rng));
    const double here = some(p);
    EXPECT_EQ(here, all(p));
    EXPECT_GE(here, geom::norm(p - goal) - 2.0 * scene.distances.cell());
  }
}

TEST(CostToGo, DoesNotPassThinWalls) {
  world::Scenario scenario;
  scenario.bounds = {{0, 0}, {10, 10}};
  scenario.models = {world::standard_car()};
  world::Obstacle wall;
  wall.shape = std::vector<geom::Vec2>{{0, 5}, {10, 5.03}, {10, 5.031}, {0, 5.001}};
  scenario.obstacles = {wall};
  const world::StaticMap map(scenario);
  const PointDistances distances(map, 0.35 * 0.4, 0.9);
  CostToGo to_go({&distances, 0.2}, {5, 8});
  EXPECT_TRUE(std::isinf(to_go({5, 2})));
  EXPECT_NEAR(to_go({1, 8}), 4.0, 0.2);
}

TEST(Route, ReversedDrivesTheSameWay) {
  Route route{{1, 2, 0.3}, {}, {{0.5, 1.0}, {0.5, 0.5}, {0.0, -0.7}, {-1.2, 0.4}}};
  route.goal = route.start;
  for (const auto& arc : route.arcs) route.goal = vehicle::drive(route.goal, arc);
  const Path there = sampled(route, 0.05), back = sampled(reversed(route), 0.05);
  ASSERT_NEAR(there.length(), back.length(), 1e-12);
  for (double s = 0.0; s <= there.length(); s += 0.03) {
    const auto a = pose_at(there, s), b = pose_at(back, there.length() - s);
    EXPECT_NEAR(geom::norm(a.position() - b.position()), 0.0, 1e-9);
  }
  merge(route.arcs);
  EXPECT_EQ(route.arcs.size(), 3u);
}

TEST(RouteCosts, PriceGearsAndStubs) {
  RouteCosts costs;
  costs.driving = {.reverse = 2.0, .gear_change = 3.0};
  costs.short_stretch = 0.5;
  const std::vector<vehicle::Arc> forward{{0.0, 2.0}}, there_and_back{{0.0, 2.0}, {0.0, -1.0}},
      stub{{0.0, 2.0}, {0.0, -0.25}};
  EXPECT_DOUBLE_EQ(costs.of({}, forward), 2.0);
  EXPECT_DOUBLE_EQ(costs.of({}, there_and_back), 2.0 + 3.0 + 2.0);
  EXPECT_DOUBLE_EQ(costs.of({}, stub), 2.0 + 3.0 + 0.5 + 3.0);
}

TEST(Shorten, TakesWigglesOut) {
  world::Scenario scenario;
  scenario.bounds = {{-5, -5}, {15, 5}};
  scenario.models = {world::standard_car()};
  const world::StaticMap map(scenario);
  const FootprintChecker checker(map, nullptr, scenario.models[0], 0.05);
  RouteCosts costs;
  costs.radius = 0.52;
  costs.driving.gear_change = 1.0;
  Route route{{0, 0, 0}, {}, {}};
  for (int i = 0; i < 8; ++i) route.arcs.push_back({i % 4 == 0 || i % 4 == 3 ? 1.0 : -1.0, 0.5});
  route.goal = route.start;
  for (const auto& arc : route.arcs) route.goal = vehicle::drive(route.goal, arc);
  const double before = costs.of(route.start, route.arcs);
  shorten(route, checker, costs);
  EXPECT_LT(costs.of(route.start, route.arcs), before);
  EXPECT_LE(route.arcs.size(), 5u);
}

TEST(FootprintChecker, ReachEndsWhereTheSweepDoes) {
  world::Scenario scenario;
  scenario.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  scenario.models = {vehicle::Model{.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1)}};
  scenario.obstacles.push_back(
      {.shape = std::vector<geom::Vec2>{{1.0, -0.5}, {1.2, -0.5}, {1.2, 0.5}, {1.0, 0.5}}});
  const world::StaticMap map(scenario);
  FootprintChecker checker(map, nullptr, scenario.models[0], 0.05);
  checker.set_slack(0.01);
  const geom::Pose2 start{};
  for (const double bend : {0.0, 0.5, -1.0, 2.0}) {
    const vehicle::Arc arc{bend, 2.0};
    const double reach = checker.reach(start, checker.room(start), arc);
    if (bend == 0.0) {
      EXPECT_NEAR(reach, 1.0 - 0.5 - 0.05 - 0.01, 1e-3);
    }
    if (reach > 0.0) {
      EXPECT_TRUE(checker.clear(start, {bend, reach}));
    }
    if (reach < 2.0) {
      EXPECT_FALSE(checker.clear(start, {bend, reach + 2e-3}));
    }
  }
}

}  // namespace
}  // namespace seine::search
