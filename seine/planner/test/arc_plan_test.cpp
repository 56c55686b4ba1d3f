#include "seine/planner/arc_plan.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/certify/certificate.hpp"
#include "seine/planner/planner.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"

namespace seine::planner {
namespace {

constexpr std::uint64_t kSeed = 11;

TEST(ArcPlan, EveryPathOfTheSearchIsDrivenToTheLetter) {
  SCOPED_TRACE(kSeed);
  int driven = 0;
  for (const vehicle::CatalogueEntry& entry : vehicle::catalogue()) {
    for (std::uint64_t seed = kSeed; seed < kSeed + std::uint64_t{effort(3, 1)}; ++seed) {
      const world::Scenario scenario = world::everyday(world::Everyday::lot, entry.model, seed);
      const world::StaticMap map(scenario);
      const world::Robot& robot = scenario.robots[0];
      const std::optional<search::Path> path =
          search::PathPlanner(map, scenario.models[0])
              .plan(robot.start, *robot.goal, {.clearance = scenario.margins.obstacle});
      if (!path || path->points.size() < 2) continue;
      const traj::TeamTrajectory plan{{drive_arcs(*path, scenario.models[0])}};
      const certify::Certificate certificate = certify::certify(scenario, map, plan, {});
      EXPECT_TRUE(certificate.holds) << scenario.name << ": " << certificate.violations.front().text;
      ++driven;
    }
  }
  EXPECT_GE(driven, effort(30, 8));
}

/// Slots of 1.4 to 1.6 lengths, doors, garages: a driver gets in and out, so does every car of the catalogue.
TEST(Plan, GetsIntoTightPlacesAndOut) {
  for (const world::Everyday kind : {world::Everyday::parallel, world::Everyday::pocket}) {
    constexpr std::array kNames{"letter", "hunter", "rc-1-10", "autoware"};
    for (const char* name : std::span(kNames).first(effort(4, 1))) {
      const vehicle::Model* model = vehicle::catalogued(name);
      ASSERT_NE(model, nullptr);
      const world::Scenario scenario = world::everyday(kind, *model, kSeed);
      const PlanResult result = plan(scenario, {.threads = 1});
      EXPECT_TRUE(result.certified) << scenario.name << ": " << result.reason;
    }
  }
}

/// A wall beside, before or behind the car, exactly at the margin or with a millimetre or three to spare.
TEST(Plan, LeavesAndReachesPlacesAtTheMargin) {
  for (const double spare : {0.0, 0.001, 0.003}) {
    if (effort(1, 0) == 0 && spare != 0.001) continue;
    for (const bool leaves : {true, false}) {
      world::Scenario scenario;
      scenario.bounds = {{-8.0, -8.0}, {8.0, 8.0}};
      scenario.models = {{.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1)}};
      scenario.margins = {0.05, 0.05};
      const double face = -0.25 - spare;
      scenario.obstacles.push_back({.name = "wall",
                                    .shape = std::vector<geom::Vec2>{
                                        {-5.0, face - 0.1}, {5.0, face - 0.1}, {5.0, face}, {-5.0, face}}});
      const geom::Pose2 at_wall{}, along{3.0, 0.0, 0.0};
      scenario.robots.push_back(
          {.name = "car", .start = leaves ? at_wall : along, .goal = leaves ? along : at_wall});
      const PlanResult result = plan(scenario, {.threads = 1});
      EXPECT_TRUE(result.certified) << spare << leaves << ": " << result.reason;
      if (result.certified) {
        EXPECT_LT(result.plan.makespan(), 3.0);
      }
    }
  }
}

}  // namespace
}  // namespace seine::planner
