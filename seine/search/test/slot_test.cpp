// Out of kerbside slots and into them, for every vehicle.
#include <gtest/gtest.h>

#include "seine/base/effort.hpp"
#include "seine/search/rolling_start.hpp"
#include "seine/search/slot.hpp"
#include "seine/search/test/path_check.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"

namespace seine::search {
namespace {

constexpr std::uint64_t kSeeds = effort(6, 1);

int gear_changes(const Route& route) {
  int changes = 0;
  for (std::size_t i = 1; i < route.arcs.size(); ++i)
    changes += route.arcs[i].gear() != route.arcs[i - 1].gear();
  return changes;
}

TEST(Slot, EveryVehicleGetsOutOfAKerbsideSlotAndIn) {
  for (const vehicle::CatalogueEntry& entry : vehicle::catalogue())
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(entry.model.name + ", seed " + std::to_string(seed));
      const world::Scenario scenario = world::everyday(world::Everyday::parallel, entry.model, seed);
      const world::StaticMap map(scenario);
      const geom::Pose2 start = scenario.robots[0].start, goal = *scenario.robots[0].goal;
      FootprintChecker checker(map, nullptr, entry.model, scenario.margins.obstacle);
      const double at_start = checker.exact_room(start), at_goal = checker.exact_room(goal);
      const bool leaving = at_start <= at_goal;
      checker.set_slack(0.2 * std::min(at_start, at_goal));
      const SlotProblem problem{.inside = leaving ? start : goal,
                                .outside = leaving ? goal : start,
                                .leaving = leaving,
                                .checker = &checker,
                                .radius = 1.03 / entry.model.max_curvature(),
                                .max_expansions = 4000};
      const SlotResult result = search_slot(problem);
      ASSERT_TRUE(result.route);
      EXPECT_LE(gear_changes(*result.route), 16);
      expect_sound(sampled(*result.route, 0.02 * entry.model.length()), start, goal, map, entry.model,
                   scenario.margins.obstacle, 2e-3 * entry.model.length());
      const SlotResult again = search_slot(problem);
      ASSERT_TRUE(again.route);
      ASSERT_EQ(again.route->arcs.size(), result.route->arcs.size());
      for (std::size_t i = 0; i < again.route->arcs.size(); ++i)
        EXPECT_EQ(again.route->arcs[i].distance, result.route->arcs[i].distance);
    }
}

// What a car can do forwards out of a slot it can do backwards into it.
TEST(Slot, TheWayInIsTheWayOutBackwards) {
  vehicle::Model model = *vehicle::catalogued("letter");
  model.limits.reverse_speed = model.limits.speed;
  const world::Scenario scenario = world::everyday(world::Everyday::parallel, model, 2);
  const world::StaticMap map(scenario);
  const FootprintChecker checker(map, nullptr, model, scenario.margins.obstacle);
  SlotProblem problem{.inside = *scenario.robots[0].goal,
                      .outside = scenario.robots[0].start,
                      .leaving = true,
                      .checker = &checker,
                      .radius = 1.0 / model.max_curvature()};
  const SlotResult out = search_slot(problem);
  problem.leaving = false;
  const SlotResult in = search_slot(problem);
  ASSERT_TRUE(out.route && in.route);
  const Route back = reversed(*out.route);
  ASSERT_EQ(back.arcs.size(), in.route->arcs.size());
  for (std::size_t i = 0; i < back.arcs.size(); ++i)
    EXPECT_DOUBLE_EQ(back.arcs[i].distance, in.route->arcs[i].distance);
}

TEST(Slot, ACarWithoutReverseIsNotSentBackwards) {
  vehicle::Model model = *vehicle::catalogued("commonroad-1");
  model.limits.reverse_speed = 0.0;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const world::Scenario scenario = world::everyday(world::Everyday::lot, model, seed);
    const world::StaticMap map(scenario);
    const FootprintChecker checker(map, nullptr, model, scenario.margins.obstacle);
    const SlotResult result = search_slot({.inside = *scenario.robots[0].goal,
                                           .outside = scenario.robots[0].start,
                                           .leaving = false,
                                           .checker = &checker,
                                           .radius = 1.0 / model.max_curvature()});
    if (!result.route) continue;
    ++found;
    for (const vehicle::Arc& arc : result.route->arcs) EXPECT_GE(arc.distance, -1e-9);
  }
  EXPECT_GT(found, 2);
}

// A car that hardly can stop before a wall is told how much room it needs and has.
TEST(Slot, AMovingStartSaysHowMuchRoomItHas) {
  world::Scenario scenario;
  const vehicle::Model model = *vehicle::catalogued("letter");
  scenario.models = {model};
  scenario.bounds = {{-9.0, -9.0}, {9.0, 9.0}};
  RollingStart rolling{nullptr, &model, {0.0, 0.0, 0.0}, 0.8 * model.limits.speed, 0.0};
  const double front = geom::bounding_box(model.footprint).high.x, needed = rolling.braking_distance(1.0);
  for (const double share : {0.9, 1.02, 1.1, 1.5}) {
    scenario.obstacles = {{.name = "wall",
                           .shape = std::vector<geom::Vec2>{{front + share * needed, -3.0},
                                                            {front + share * needed + 0.2, -3.0},
                                                            {front + share * needed + 0.2, 3.0},
                                                            {front + share * needed, 3.0}}}};
    const world::StaticMap map(scenario);
    rolling.map = &map;
    EXPECT_EQ(no_room_to_stop(rolling).empty(), share > 1.2) << share;
    const std::optional<Path> braking = brake_before_obstacle(rolling, 0.985);
    EXPECT_EQ(braking.has_value(), share > 1.0) << share;
    if (braking) {
      EXPECT_LE(braking->length(), share * needed + 2e-4);
    }
  }
}

}  // namespace
}  // namespace seine::search
