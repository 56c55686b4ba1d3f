#include "bench/net/pocket_scene.hpp"

#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/world/net_families.hpp"

namespace seine::bench {

world::Scenario pocket_scene(int robots, std::uint64_t seed) {
  constexpr double kGap = 2.6, kThick = 0.3;       // m
  constexpr double kTurn = 0.15, kSteering = 0.3;  // rad
  // A carry of the family without its walls: the team, its net and load are the same.
  world::Scenario scenario = world::gap_scene(robots, seed, kGap);
  Rng rng(seed);
  double reach = 0.0, heading = 0.0;
  geom::Vec2 middle;
  for (const world::Robot& robot : scenario.robots) {
    middle += robot.start.position() / static_cast<double>(robots);
    heading = robot.start.heading;
  }
  for (const world::Robot& robot : scenario.robots)
    reach = std::max(reach, geom::norm(robot.start.position() - middle) + 0.55);
  const geom::Pose2 frame{middle.x, middle.y, heading};
  const auto place = [&](double x, double y) { return frame * geom::Vec2{x, y}; };
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    scenario.obstacles.push_back(
        {.shape = std::vector<geom::Vec2>{place(x0, y0), place(x1, y0), place(x1, y1), place(x0, y1)}});
  };
  const double front = reach + rng.uniform(0.15, 0.5), side = reach + rng.uniform(0.1, 0.4);
  const double back = -reach - rng.uniform(0.3, 1.2);
  // Wide turns and a wall not far behind: turning round instead would take longer.
  scenario.models.front().limits.steering = kSteering;
  const double end = back - 2.0 * reach - rng.uniform(1.5, 2.5);
  scenario.name = "pocket-" + std::to_string(robots) + "-" + std::to_string(seed);
  scenario.obstacles.clear();
  scenario.bounds = {{-16.0, -16.0}, {16.0, 16.0}};
  wall(front, -side - kThick, front + kThick, side + kThick);
  wall(back, side, front, side + kThick);
  wall(back, -side - kThick, front, -side);
  wall(end - kThick, -4.0 * side, end, 4.0 * side);
  const double beside = (rng.uniform() < 0.5 ? 1.0 : -1.0) * (2.0 * side + rng.uniform(1.2, 2.5));
  scenario.delivery =
      net::Delivery{place(rng.uniform(0.5, 3.5), beside), 0.4, heading + rng.uniform(-kTurn, kTurn)};
  return scenario;
}

}  // namespace seine::bench
