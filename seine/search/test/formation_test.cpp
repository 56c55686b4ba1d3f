#include "seine/search/formation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"
#include "seine/search/formation_shapes.hpp"
#include "seine/world/net_families.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

Vec2 middle_of(const world::Scenario& scenario, const Formation& formation, const geom::Pose2& frame) {
  std::vector<Vec2> ring;
  attachments_at(scenario, formation, frame, ring);
  Vec2 sum;
  for (const Vec2 a : ring) sum += a / static_cast<double>(ring.size());
  return sum;
}

// A scene of the throw family as a problem for the search; everything tall is in the way of the net.
struct Throw {
  explicit Throw(int robots, std::uint64_t seed)
      : scenario(world::throw_scene(robots, seed)), map(scenario), tall(scenario) {
    problem.scenario = &scenario, problem.map = &map, problem.tall = &tall;
    problem.start = formation_frame(scenario);
    problem.shapes = {start_formation(scenario)};
    problem.shapes.front().lowest = 1e9;
    const Vec2 ahead = problem.start.position() + 3.0 * problem.start.direction();
    problem.meetings = {{ahead, 0.3, 2.5}};
    problem.goal = FormationGoal{scenario.delivery->center, 0.35, {}};
  }
  world::Scenario scenario;
  world::StaticMap map, tall;
  FormationProblem problem;
};

TEST(Formation, WaysAreClearDriveableAndKeepTheirRendezvous) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    Throw t(3 + static_cast<int>(seed % 4), seed);
    const auto way = FormationSearch(t.problem).find({});
    if (!way) continue;
    ++found;
    const auto& points = way->path.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double step = points[i].s - points[i - 1].s;
      ASSERT_GE(step, 0.0);
      EXPECT_LE(std::abs(points[i].curvature), t.scenario.models[0].max_curvature());
      EXPECT_LE(geom::norm(points[i].pose.position() - points[i - 1].pose.position()), step + 1e-9);
      for (std::size_t k = 0; k < t.scenario.robots.size(); ++k) {
        const Vec2 at = points[i].pose.position() + t.problem.shapes[0].offsets[k];
        const geom::Convex car =
            geom::placed({t.scenario.models[0].footprint, 0.0}, {at.x, at.y, points[i].pose.heading});
        EXPECT_TRUE(t.map.clear(car.core, t.scenario.margins.obstacle)) << "seed " << seed << ", point " << i;
      }
    }
    ASSERT_EQ(way->meeting_s.size(), 1u);
    const Vec2 there = middle_of(t.scenario, t.problem.shapes[0], pose_at(way->path, way->meeting_s[0]));
    EXPECT_LE(geom::norm(there - t.problem.meetings[0].point), t.problem.meetings[0].reach + 1e-6);
    const Vec2 end = middle_of(t.scenario, t.problem.shapes[0], points.back().pose);
    EXPECT_LE(geom::norm(end - t.problem.goal->center), t.problem.goal->radius + 1e-6);
  }
  EXPECT_GE(found, 10) << "of 16";
}

TEST(Formation, TimingKeepsTheLimitsAndIsOnTimeWhereItCanBe) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    Throw t(4, seed);
    const auto way = FormationSearch(t.problem).find({});
    if (!way) continue;
    for (const double time : {1.6, 2.5, 4.0}) {
      t.problem.meetings[0].time = time;
      const FormationTiming timing = time_formation(*way, t.problem);
      const vehicle::Limits& limits = t.scenario.models[0].limits;
      for (std::size_t i = 1; i < timing.profile.size(); ++i) {
        const ProfileKnot &a = timing.profile[i - 1], &b = timing.profile[i];
        ASSERT_GT(b.t, a.t);
        EXPECT_LE(b.v, limits.speed);
        EXPECT_LE(std::abs(b.v - a.v) / (b.t - a.t), limits.acceleration);
      }
      EXPECT_EQ(timing.profile.back().v, 0.0);
      const TimedPath timed{way->path, timing.profile};
      if (timing.slack >= 0.0) {
        EXPECT_NEAR(timed.at(time).s, way->meeting_s[0], 0.02) << "seed " << seed << ", time " << time;
      } else {
        EXPECT_LT(timed.at(time).s, way->meeting_s[0]);
      }
    }
  }
}

TEST(Formation, AWallWithoutAGapHasNoWay) {
  Throw t(4, 1);
  t.scenario.obstacles.clear();
  const double x = t.problem.start.x + 2.5;
  const geom::Box& b = t.scenario.bounds;
  world::Obstacle wall;
  wall.shape = std::vector<Vec2>{{x, b.low.y}, {x + 0.3, b.low.y}, {x + 0.3, b.high.y}, {x, b.high.y}};
  t.scenario.obstacles.push_back(wall);
  const world::StaticMap map(t.scenario);
  t.problem.map = t.problem.tall = &map;
  t.problem.meetings.clear();
  t.problem.goal = FormationGoal{{x + 3.0, t.problem.start.y}, 0.35, {}};
  EXPECT_FALSE(FormationSearch(t.problem).find({.max_expansions = 3000, .field = true}).has_value());
}

// A wall with a gap too narrow for the team as it stands: on the way through, and while the shape changes,
// every car keeps its distance and the net has no wall in it.
TEST(Formation, ChangesShapeWhereThereIsRoom) {
  int changed = 0;
  for (const int robots : {3, 4}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const world::Scenario scenario = world::gap_scene(robots, seed, 2.0);
      const world::StaticMap map(scenario);
      FormationProblem problem;
      problem.scenario = &scenario, problem.map = problem.tall = &map;
      problem.start = formation_frame(scenario);
      problem.shapes = {start_formation(scenario)};
      problem.shapes.front().lowest = 1e9;
      problem.goal = FormationGoal{scenario.delivery->center, 0.35, {}};
      FormationSearch search(problem);
      search.offer(narrow_shapes(scenario, problem.start.heading, true, {{scenario.net->clearance}}));
      const auto way = search.find({.heuristic_weight = 2.5, .field = true});
      ASSERT_TRUE(way) << robots << " cars, seed " << seed;
      std::size_t held = 0;
      std::vector<Vec2> ring;
      Formation now = problem.shapes.front();
      for (const PathPoint& point : way->path.points) {
        while (held + 1 < way->shapes.size() && point.s >= way->shapes[held + 1].s) ++held;
        const auto& shapes = search.problem().shapes;
        now = shapes[static_cast<std::size_t>(way->shapes[held].shape)];
        if (held + 1 < way->shapes.size()) {
          const FormationPath::Shape& next = way->shapes[held + 1];
          const double share = (point.s - next.begin) / (next.s - next.begin);
          const Formation before = now;
          between(before, shapes[static_cast<std::size_t>(next.shape)], share, now);
        }
        for (std::size_t k = 0; k < now.offsets.size(); ++k) {
          const Vec2 at = point.pose.position() + now.offsets[k];
          const geom::Convex car =
              geom::placed({scenario.models[0].footprint, 0.0}, {at.x, at.y, point.pose.heading});
          EXPECT_TRUE(map.clear(car.core, scenario.margins.obstacle))
              << robots << " cars, seed " << seed << ", car " << k << " at s = " << point.s;
        }
        attachments_at(scenario, now, point.pose, ring);
        EXPECT_TRUE(map.clear(ring, 0.0)) << robots << " cars, seed " << seed << ", net at s = " << point.s;
      }
      changed += way->shapes.size() > 1;
    }
  }
  EXPECT_GE(changed, 8) << "of 12 change their shape";
}

TEST(NarrowShapes, KeepTheNetSafeAndTheCarsApart) {
  for (const int robots : {3, 4, 5, 6}) {
    const world::Scenario scenario = world::gap_scene(robots, 3);
    const double heading = formation_frame(scenario).heading;
    const auto shapes = narrow_shapes(scenario, heading, true, {{0.05}});
    EXPECT_GE(shapes.size(), 6u) << robots << " cars";
    const net::Net& net = *scenario.net;
    for (const Formation& shape : shapes) {
      std::vector<Vec2> ring;
      attachments_at(scenario, shape, {0.0, 0.0, heading}, ring);
      for (std::size_t i = 0; i < ring.size(); ++i)
        for (std::size_t j = i + 1; j < ring.size(); ++j)
          EXPECT_LE(geom::norm(ring[i] - ring[j]), net.stretch * net::rest_distance(net, i, j));
      EXPECT_GE(net.rim() - net::loaded_depth(net, ring), 0.05);
      EXPECT_NEAR(shape.lowest, net.rim() - net::loaded_depth(net, ring), 1e-9);
      EXPECT_GT(net::opening(net, ring), 0.3);
    }
  }
}

}  // namespace
}  // namespace seine::search
