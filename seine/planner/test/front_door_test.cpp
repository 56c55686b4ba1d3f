#include "seine/planner/front_door.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/world/families.hpp"
#include "seine/world/frame.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {
namespace {

// Far away the plan is that of the same scenario near the origin, moved there, to the last bit.
TEST(FrontDoor, APlanFarFromTheOriginIsTheSamePlan) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const world::Scenario near = world::generate(world::Family::random, 3, seed);
    const geom::Vec2 by{448125.0, 5411825.0};
    // Coordinates rounded as they are out there.
    const world::Scenario far = world::seen_from(near, -1.0 * by);
    const auto origin = world::local_origin(far);
    ASSERT_TRUE(origin);
    EXPECT_FALSE(world::local_origin(near));
    const PlanResult there = plan(far), here = plan(world::seen_from(far, *origin));
    ASSERT_TRUE(there.certified) << there.reason;
    EXPECT_EQ(there.quality.makespan, here.quality.makespan);
    const world::StaticMap map(far);
    EXPECT_TRUE(certify::certify(far, map, there.plan).holds);
    for (double t = 0.0; t < here.plan.makespan(); t += 0.1)
      for (std::size_t k = 0; k < near.robots.size(); ++k) {
        const geom::Pose2 a = there.plan.robots[k].at(t).pose, b = here.plan.robots[k].at(t).pose;
        EXPECT_NEAR(a.x - origin->x, b.x, 1e-8);
        EXPECT_NEAR(a.y - origin->y, b.y, 1e-8);
      }
  }
}

world::Scenario beside_a_wall(double gap) {
  world::Scenario scenario;
  scenario.bounds = {{-8, -8}, {8, 8}};
  vehicle::Model model{
      .name = "default", .footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1), .limits = {}};
  model.limits.lateral_acceleration = 3.0;
  scenario.models = {model};
  scenario.robots = {{.name = "car0", .start = {0, 0, 0}, .goal = geom::Pose2{3, 0.5, 0}}};
  const double x = -0.1 - gap, y = -0.2 - gap;
  scenario.obstacles = {
      {.name = "post", .shape = std::vector<geom::Vec2>{{-2, -1}, {x, -1}, {x, 1}, {-2, 1}}},
      {.name = "wall", .shape = std::vector<geom::Vec2>{{-1, y - 1}, {2, y - 1}, {2, y}, {-1, y}}}};
  return scenario;
}

TEST(FrontDoor, ACarMayLeaveThePlaceInsideTheMarginWhereItStands) {
  for (const double gap : {0.012, 0.02, 0.03, 0.045}) {
    SCOPED_TRACE(gap);
    world::Scenario scenario = beside_a_wall(gap);
    EXPECT_THROW(plan(scenario), std::exception);
    scenario.margins.leaving = 0.0;
    const PlanResult result = plan(scenario);
    ASSERT_TRUE(result.certified) << result.reason;
    // It is not a smaller margin for the whole drive: with a wall in front of the goal …
    world::Scenario strict = scenario;
    strict.margins.leaving.reset();
    EXPECT_FALSE(certify::certify(strict, world::StaticMap(strict), result.plan).holds);
  }
}

TEST(FrontDoor, AStartSpeedALittleOverTheLimitIsTheLimit) {
  world::Scenario scenario = beside_a_wall(0.2);
  scenario.robots[0].start_speed = 2.5001;
  scenario.robots[0].goal = geom::Pose2{5, 0, 0};
  const PlanResult result = plan(scenario);
  ASSERT_TRUE(result.certified) << result.reason;
  EXPECT_TRUE(certify::certify(scenario, world::StaticMap(scenario), result.plan).holds);
}

}  // namespace
}  // namespace seine::planner
