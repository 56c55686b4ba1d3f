#include "seine/search/gates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/test/path_check.hpp"
#include "seine/vehicle/catalogue.hpp"

namespace seine::search {
namespace {

constexpr std::uint64_t kSeed = 11;
constexpr double kClearance = 0.01;  // m

/// A wall with a door, turned by any angle, in a large field. In the wall's own frame it lies along y and the
/// door's middle is the origin.
struct Door {
  world::Scenario scenario;
  geom::Pose2 frame;

  Door(const vehicle::Model& model, double play, double thick, double turn) : frame{0.0, 0.0, turn} {
    const double far = 4.0 * (model.length() + 1.0 / model.max_curvature());
    const double half = 0.5 * (model.width() + play) + kClearance;
    scenario.bounds = {{-far, -far}, {far, far}};
    scenario.models = {model};
    scenario.margins.obstacle = kClearance;
    for (const double side : {-1.0, 1.0}) {
      world::Obstacle wall;
      std::vector<geom::Vec2> corners;
      for (const geom::Vec2 corner :
           {geom::Vec2{-0.5 * thick, half}, geom::Vec2{0.5 * thick, half}, geom::Vec2{0.5 * thick, 2.0 * far},
            geom::Vec2{-0.5 * thick, 2.0 * far}})
        corners.push_back(frame * geom::Vec2{corner.x, side * corner.y});
      wall.shape = corners;
      scenario.obstacles.push_back(wall);
    }
  }
  geom::Pose2 place(double x, double y, double heading) const {
    const geom::Vec2 at = frame * geom::Vec2{x, y};
    return {at.x, at.y, geom::wrap_angle(frame.heading + heading)};
  }
};

TEST(Gates, StandInTheMiddleOfADoorAndAlongIt) {
  Rng rng(kSeed);
  for (int trial = 0; trial < effort(24, 5); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const auto entries = vehicle::catalogue();
    const vehicle::Model& model = entries[static_cast<std::size_t>(trial) % entries.size()].model;
    const double play = rng.uniform(0.01, 0.08) * model.width();
    const Door door(model, play, rng.uniform(0.1, 1.0) * model.length(), rng.uniform(-3.0, 3.0));
    const world::StaticMap map(door.scenario);
    const double far = 3.0 * model.length();
    const geom::Pose2 start = door.place(-far, rng.uniform(-1.0, 1.0) * model.length(), 0.2);
    const geom::Pose2 goal = door.place(far, rng.uniform(-1.0, 1.0) * model.length(), -0.2);

    const DiscCover cover(model.footprint);
    const PointDistances grid(map, 0.12 * model.width(), model.length());
    const double radius = cover.widest().inner + kClearance;
    const DiscWay way{&grid, radius, radius + 0.3 * model.width(), 10};
    const geom::Vec2 reference{cover.widest().x, cover.axis};
    CostToGo to_go(way, goal * reference);
    const auto gates = gates_between(map, model, to_go, way, reference, start, goal, kClearance);
    ASSERT_EQ(gates.size(), 1u);
    const geom::Box body = geom::bounding_box(model.footprint);
    const geom::Vec2 middle = gates[0].pose * (0.5 * (body.low + body.high));
    const geom::Vec2 across = door.frame * geom::Vec2{0.0, 1.0};
    EXPECT_LE(std::abs(geom::dot(middle, across)), 0.5 * play);
    EXPECT_NEAR(geom::wrap_angle(gates[0].pose.heading - door.frame.heading), 0.0, 0.1);
    EXPECT_GE(gates[0].room, 0.0);
    EXPECT_LE(gates[0].room, 0.5 * play + 1e-9);

    // And the way leads through.
    PathOptions options;
    options.clearance = kClearance;
    const auto path = PathPlanner(map, model).plan(start, goal, options);
    ASSERT_TRUE(path);
    expect_sound(*path, start, goal, map, model, kClearance);
  }
}

TEST(Gates, AreNoneWhereTheFootprintDoesNotFit) {
  const vehicle::Model& model = *vehicle::catalogued("letter");
  const Door door(model, -0.05 * model.width(), 0.3, 0.4);
  const world::StaticMap map(door.scenario);
  const DiscCover cover(model.footprint);
  const PointDistances grid(map, 0.12 * model.width(), model.length());
  // A disc a little smaller than the car does go through.
  const DiscWay way{&grid, 0.4 * model.width(), 0.0, 1};
  const geom::Vec2 reference{cover.widest().x, cover.axis};
  const geom::Pose2 start = door.place(-2.0, 0.0, 0.0), goal = door.place(2.0, 0.0, 0.0);
  CostToGo to_go(way, goal * reference);
  EXPECT_TRUE(std::isfinite(to_go(start * reference)));
  EXPECT_TRUE(gates_between(map, model, to_go, way, reference, start, goal, kClearance).empty());
}

}  // namespace
}  // namespace seine::search
