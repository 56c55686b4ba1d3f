#include "seine/search/refuge.hpp"

#include <gtest/gtest.h>

#include "seine/geom/convex.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/search/velocity.hpp"
#include "seine/vehicle/catalogue.hpp"

namespace seine::search {
namespace {

// Two lanes of 1 m that cross: a car on the level one finds the other.
world::Scenario crossroads() {
  world::Scenario scenario;
  scenario.bounds = {{-4.0, -4.0}, {4.0, 4.0}};
  scenario.models = {*vehicle::catalogued("letter")};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      world::Obstacle corner;
      const double x0 = x < 0.0 ? -4.0 : 0.5, y0 = y < 0.0 ? -4.0 : 0.5;
      corner.shape = std::vector<geom::Vec2>{{x0, y0}, {x0 + 3.5, y0}, {x0 + 3.5, y0 + 3.5}, {x0, y0 + 3.5}};
      scenario.obstacles.push_back(corner);
    }
  return scenario;
}

TEST(Refuges, AreFoundInSideRoadsAndKeepOffTheLane) {
  const world::Scenario scenario = crossroads();
  const world::StaticMap map(scenario);
  const vehicle::Model& model = scenario.models[0];
  const PathPlanner planner(map, model);
  const auto other = planner.plan({3.0, 0.0, 3.14159265}, {-3.0, 0.0, 3.14159265}, {});
  ASSERT_TRUE(other);
  Lane lane;
  lane.add(model, *other, 0.05);
  const FootprintChecker checker(map, nullptr, model, 0.05);
  const double radius = 1.1 / model.max_curvature();
  const auto found =
      refuges({-2.5, 0.0, 0.0}, checker, lane,
              {.radius = radius, .step = 0.4 * radius, .cell = 0.2 * radius, .headings = 36}, 2);
  ASSERT_FALSE(found.empty());
  std::vector<geom::Vec2> stands(model.footprint.size()), passes(model.footprint.size());
  for (const Route& route : found) {
    EXPECT_GT(std::abs(route.goal.y), 0.2);  // off the lane
    geom::place(model.footprint, route.goal, stands);
    for (double s = 0.0; s <= other->length(); s += 0.01) {
      geom::place(model.footprint, pose_at(*other, s), passes);
      ASSERT_GE(geom::distance(stands, passes), 0.05);
    }
    geom::Pose2 at = route.start;
    for (const vehicle::Arc& arc : route.arcs) {
      EXPECT_TRUE(checker.clear(at, arc));
      at = vehicle::drive(at, arc);
    }
    EXPECT_NEAR(at.x, route.goal.x, 1e-9);
    EXPECT_NEAR(at.y, route.goal.y, 1e-9);
  }
}

TEST(Refuges, AreNoneWhereTheLaneIsAllThereIs) {
  world::Scenario scenario;
  scenario.bounds = {{-4.0, -0.3}, {4.0, 0.3}};
  scenario.models = {*vehicle::catalogued("letter")};
  const world::StaticMap map(scenario);
  const vehicle::Model& model = scenario.models[0];
  const Path whole{{{0.0, {-3.8, 0.0, 0.0}, 0.0, 1}, {7.3, {3.5, 0.0, 0.0}, 0.0, 1}}, {}};
  Lane lane;
  lane.add(model, whole, 0.05);
  const FootprintChecker checker(map, nullptr, model, 0.05);
  EXPECT_TRUE(refuges({-2.0, 0.0, 0.0}, checker, lane, {.radius = 1.0, .step = 0.3, .cell = 0.2}, 2).empty());
}

// A path may ask for a stop where its gear does not change.
TEST(Rests, AreKeptByTheSpeedProfile) {
  const vehicle::Model& model = *vehicle::catalogued("letter");
  const SpeedGrid grid = speed_grid(model);
  Path first{{{0.0, {0.0, 0.0, 0.0}, 0.0, 1}, {3.0, {3.0, 0.0, 0.0}, 0.0, 1}}, {}};
  const Path second{{{0.0, {3.0, 0.0, 0.0}, 0.0, 1}, {3.0, {6.0, 0.0, 0.0}, 0.0, 1}}, {}};
  const auto arrival = [&](const Path& path) {
    const SpeedLattice lattice(path, grid, SweptFootprint(model.footprint));
    VelocityWorkspace workspace;
    workspace.occupied.reset(lattice, 1);
    const VelocityPlan plan = plan_velocity(lattice, workspace, {.ticks = 1000});
    EXPECT_TRUE(plan.found);
    double slowest = 1e9;
    for (const ProfileKnot& knot : plan.profile)
      if (std::abs(knot.s - 3.0) < 1e-9) slowest = std::min(slowest, knot.v);
    return std::pair(plan.arrival, slowest);
  };
  Path through = first;
  append(through, second);
  append(first, second, true);
  ASSERT_EQ(first.rests.size(), 1u);
  EXPECT_EQ(arrival(first).second, 0.0);
  EXPECT_GT(arrival(first).first, arrival(through).first + 0.1);
}

}  // namespace
}  // namespace seine::search
