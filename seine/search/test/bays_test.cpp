#include "seine/search/bays.hpp"

#include <gtest/gtest.h>

#include "seine/base/effort.hpp"
#include "seine/geom/convex.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"

namespace seine::search {
namespace {

// A lane with a bay: two cars swap their ends.
TEST(Bays, KeepOffTheWallsAndTheOthersLane) {
  int lanes = 0;
  for (const vehicle::CatalogueEntry& entry : vehicle::catalogue())
    for (std::uint64_t seed = 0; seed < std::uint64_t{effort(12, 4)}; ++seed) {
      const world::Scenario scenario = world::everyday(world::Everyday::pair, entry.model, seed);
      if (scenario.obstacles.size() != 4) continue;  // not the variant with a bay
      SCOPED_TRACE(scenario.name);
      ++lanes;
      const world::StaticMap map(scenario);
      const vehicle::Model& model = scenario.models[0];
      const PathPlanner planner(map, model);
      PathOptions options;
      options.clearance = scenario.margins.obstacle;
      const auto way = planner.plan(scenario.robots[1].start, *scenario.robots[1].goal, options);
      const auto other = planner.plan(scenario.robots[0].start, *scenario.robots[0].goal, options);
      ASSERT_TRUE(way && other);
      const auto bays = bays_beside(
          {&map, &model, &*way, &model, &*other, scenario.margins.obstacle, scenario.margins.robot});
      ASSERT_FALSE(bays.empty());
      std::vector<geom::Vec2> stands(model.footprint.size()), passes(model.footprint.size());
      for (const geom::Pose2& bay : bays) {
        geom::place(model.footprint, bay, stands);
        EXPECT_TRUE(map.clear(stands, scenario.margins.obstacle));
        for (double s = 0.0; s <= other->length(); s += 0.01 * model.length()) {
          geom::place(model.footprint, pose_at(*other, s), passes);
          ASSERT_GE(geom::distance(stands, passes), scenario.margins.robot) << "s = " << s;
        }
      }
    }
  EXPECT_GE(lanes, effort(5, 1));
}

TEST(Bays, AreNoneInALaneWithout) {
  const vehicle::Model& model = *vehicle::catalogued("letter");
  world::Scenario lane;
  lane.bounds = {{-5.0, -0.3}, {5.0, 0.3}};
  lane.models = {model};
  const world::StaticMap map(lane);
  const PathPlanner planner(map, model);
  const geom::Pose2 left{-4.0, 0.0, 0.0}, right{4.0, 0.0, 0.0};
  const auto way = planner.plan(left, right, {});
  ASSERT_TRUE(way);
  EXPECT_TRUE(bays_beside({&map, &model, &*way, &model, &*way, 0.05, 0.05}).empty());
}

}  // namespace
}  // namespace seine::search
