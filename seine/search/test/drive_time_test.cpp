#include "seine/search/drive_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/test/path_check.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kPi = 3.14159265358979323846;

vehicle::Model car() {
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
  return model;
}

double time_of(std::vector<Arc> arcs, const vehicle::Model& model) {
  return drive_time(arcs, model);
}

TEST(DriveTime, IsThatOfTheTrapezoid) {
  vehicle::Model model = car();
  model.limits.speed = 2.0, model.limits.acceleration = 1.0, model.limits.reverse_speed = 0.5;
  EXPECT_NEAR(time_of({{0.0, 1.0}}, model), 2.0, 1e-12);                     // never at full speed
  EXPECT_NEAR(time_of({{0.0, 8.0}}, model), 8.0 / 2.0 + 2.0, 1e-12);         // speeds up, cruises, brakes
  EXPECT_NEAR(time_of({{0.0, -4.0}}, model), 4.0 / 0.5 + 0.5, 1e-12);        // the reverse gear is slower
  EXPECT_NEAR(time_of({{0.0, 1.0}, {0.0, -4.0}}, model), 2.0 + 8.5, 1e-12);  // rests at the gear change
  EXPECT_NEAR(time_of({{0.0, 4.0}, {0.0, 4.0}}, model), 6.0, 1e-12);         // not within a gear
  model.limits.lateral_acceleration = 1.0;
  EXPECT_NEAR(time_of({{1.0, 10.0}}, model), 11.0, 1e-12);  // a bend at 1 m/s
  model.limits.reverse_speed = 0.0;
  EXPECT_TRUE(std::isinf(time_of({{0.0, 1.0}, {0.0, -1.0}}, model)));
}

TEST(DriveTime, TurningTheWheelTakesTimeOnlyWhereThereIsNoneToTurnIt) {
  vehicle::Model quick = car(), slow = car();
  slow.limits.steering_rate = 0.3;
  const double bend = 0.9 * slow.max_curvature();
  const std::vector<Arc> aside{{bend, 0.3}, {-bend, 0.3}};
  EXPECT_GT(time_of(aside, slow), time_of(aside, quick) + 1.0);
  const std::vector<Arc> lane{{0.01, 30.0}, {0.0, 30.0}, {-0.01, 30.0}};
  EXPECT_NEAR(time_of(lane, slow), time_of(lane, quick), 1e-9);
}

/// What a person would expect of one car in an empty field.
struct Field {
  explicit Field(vehicle::Model model) {
    scenario.bounds = {{-20.0, -20.0}, {20.0, 20.0}};
    scenario.models = {std::move(model)};
    map.emplace(scenario);
  }
  std::optional<Path> plan(const geom::Pose2& goal) const {
    return PathPlanner(*map, scenario.models[0]).plan({0.0, 0.0, 0.0}, goal, {.quickest = true});
  }
  world::Scenario scenario;
  std::optional<world::StaticMap> map;
};

TEST(Quickest, ACarWithoutReverseReachesEveryGoalInAField) {
  Rng rng(5);
  vehicle::Model model = car();
  model.limits.reverse_speed = 0.0;
  const Field field(model);
  for (int i = 0; i < 60; ++i) {
    const geom::Vec2 at = rng.uniform(0.2, 4.0) * geom::unit(rng.uniform(-kPi, kPi));
    const geom::Pose2 goal = i == 0   ? geom::Pose2{-3.0, 0.0, 0.0}
                             : i == 1 ? geom::Pose2{0.0, 0.0, kPi}
                                      : geom::Pose2{at.x, at.y, rng.uniform(-kPi, kPi)};
    const std::optional<Path> path = field.plan(goal);
    ASSERT_TRUE(path) << i;
    expect_sound(*path, {0.0, 0.0, 0.0}, goal, *field.map, model, 0.05);
    for (const PathPoint& point : path->points) EXPECT_EQ(point.gear, 1);
  }
}

TEST(Quickest, ASlowReverseGearIsUsedForShortWaysOnly) {
  for (const double reverse : {0.05, 0.1, 0.2}) {
    vehicle::Model model = car();
    model.limits.reverse_speed = reverse;
    const Field field(model);
    const std::optional<Path> far = field.plan({-5.0, 0.0, 0.0}), near = field.plan({-0.05, 0.0, 0.0});
    ASSERT_TRUE(far && near);
    EXPECT_EQ(far->points.front().gear, 1);
    EXPECT_EQ(gear_changes(*far), 0);
    EXPECT_LT(far->length(), 10.0);
    EXPECT_EQ(near->points.front().gear, -1);
  }
}

}  // namespace
}  // namespace seine::search
