// Real vehicles drive what people ask of them first: each task has a plan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/planner/planner.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/check.hpp"
#include "seine/world/everyday.hpp"

namespace seine::planner {
namespace {

using std::numbers::pi;

constexpr std::uint64_t kFirstSeed = 100, kSeeds = effort(2, 1);

/// A road car at the speed of a country road and of a motorway: v²/(a · length) of 22 and 25, where the
/// catalogue's vehicles have 2 (hunter) to 17 (f1tenth).
std::vector<vehicle::Model> fast_cars() {
  std::vector<vehicle::Model> cars(2, *vehicle::catalogued("commonroad-2"));
  cars[0].name = "road-20", cars[0].limits.speed = 20.0, cars[0].limits.acceleration = 4.0;
  cars[0].limits.lateral_acceleration = 4.0;
  cars[0].limits.steering_rate = std::numeric_limits<double>::infinity();
  cars[1].name = "road-30", cars[1].limits.speed = 30.0, cars[1].limits.acceleration = 8.0;
  cars[1].limits.lateral_acceleration = 8.0, cars[1].limits.steering_rate = 0.6;
  return cars;
}

std::vector<vehicle::Model> vehicles() {
  std::vector<vehicle::Model> all = fast_cars();
  for (const vehicle::CatalogueEntry& entry : vehicle::catalogue()) all.push_back(entry.model);
  return all;
}

// What the vehicle needs to turn, or to reach half of its speed and stop again.
double scale_of(const vehicle::Model& car) {
  return std::max({1.0 / car.max_curvature(), car.length(),
                   0.5 * car.limits.speed * car.limits.speed / car.limits.acceleration});
}

world::Scenario field(const vehicle::Model& car, const geom::Pose2& start, const geom::Pose2& goal,
                      double half) {
  world::Scenario scenario;
  scenario.name = car.name;
  scenario.models = {car};
  scenario.bounds = {{-half, -half}, {half, half}};
  scenario.margins.obstacle = std::min(0.05, 0.05 * car.length());
  scenario.robots = {{.name = "a", .model = 0, .start = start, .goal = goal}};
  return scenario;
}

void expect_a_plan(const world::Scenario& scenario, std::uint64_t seed) {
  const PlanResult result = plan(scenario, {.threads = 1});
  EXPECT_TRUE(result.certified) << scenario.name << ", seed " << seed << ": " << result.reason;
}

TEST(Vehicles, DriveAnywhereInAnOpenField) {
  for (const vehicle::Model& car : vehicles())
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 2 * kSeeds; ++seed) {
      Rng rng(seed);
      const double scale = scale_of(car), far = scale * rng.uniform(0.3, 5.0), where = rng.uniform(-pi, pi);
      const geom::Pose2 goal{far * std::cos(where), far * std::sin(where), rng.uniform(-pi, pi)};
      const world::Scenario scenario = field(car, {}, goal, 10.0 * scale);
      const PlanResult result = plan(scenario, {.threads = 1});
      ASSERT_TRUE(result.certified) << car.name << ", seed " << seed << ": " << result.reason;
      // Nothing is in the way: the first try holds.
      EXPECT_EQ(result.repairs, 0) << car.name << ", seed " << seed;
    }
}

TEST(Vehicles, ReverseToAPlaceBehind) {
  for (const vehicle::Model& car : vehicles())
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
      Rng rng(seed);
      const double scale = scale_of(car);
      const geom::Pose2 goal{-rng.uniform(0.2, 3.0) * scale, rng.uniform(-0.6, 0.6) * scale,
                             rng.uniform(-0.6, 0.6)};
      expect_a_plan(field(car, {}, goal, 8.0 * scale), seed);
    }
}

TEST(Vehicles, PassANarrowGapInAWall) {
  for (const vehicle::Model& car : vehicles())
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
      Rng rng(seed);
      const double half = 3.0 / car.max_curvature() + 3.0 * car.length(), thick = 0.25 * car.length();
      const geom::Pose2 start{-0.6 * half, rng.uniform(-0.5, 0.5) * half, rng.uniform(-1.0, 1.0)};
      const geom::Pose2 goal{0.6 * half, rng.uniform(-0.5, 0.5) * half, rng.uniform(-1.0, 1.0)};
      world::Scenario scenario = field(car, start, goal, half);
      const double y = rng.uniform(-0.5, 0.5) * car.length();
      const double room = 0.5 * car.width() * (1.0 + rng.uniform(0.05, 0.3)) + scenario.margins.obstacle;
      for (const auto& [low, high] : {std::pair{-half, y - room}, std::pair{y + room, half}})
        scenario.obstacles.push_back(
            {.name = "wall",
             .shape = std::vector<geom::Vec2>{{-thick, low}, {thick, low}, {thick, high}, {-thick, high}}});
      expect_a_plan(scenario, seed);
    }
}

TEST(Vehicles, DriveASlalomAndParkInALot) {
  for (const vehicle::Model& car : vehicles())
    for (const world::Everyday kind : {world::Everyday::slalom, world::Everyday::lot})
      for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed)
        expect_a_plan(world::everyday(kind, car, seed), seed);
}

}  // namespace
}  // namespace seine::planner
