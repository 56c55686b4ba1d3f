#include "seine/sim/clearance.hpp"

#include <algorithm>

#include "seine/world/check_parts.hpp"

namespace seine::sim {

using geom::Convex;
using geom::Pose2;

Pose2 pose_at(std::span<const world::Waypoint> motion, double time) {
  const auto after =
      std::find_if(motion.begin(), motion.end(), [&](const world::Waypoint& w) { return w.t >= time; });
  if (after == motion.begin()) return motion.front().pose;
  if (after == motion.end()) return motion.back().pose;
  const world::Waypoint &a = *(after - 1), &b = *after;
  const double part = (time - a.t) / (b.t - a.t);
  return {a.pose.x + part * (b.pose.x - a.pose.x), a.pose.y + part * (b.pose.y - a.pose.y),
          geom::wrap_angle(a.pose.heading + part * geom::wrap_angle(b.pose.heading - a.pose.heading))};
}

Surroundings::Surroundings(const world::Scenario& scenario) : scenario_(scenario), map_(scenario) {
  for (const world::Obstacle& obstacle : scenario.obstacles)
    if (!obstacle.motion.empty()) movers_.push_back({world::body_of(obstacle), obstacle.motion});
}

double Surroundings::to_movers(double time, const Convex& car) const {
  double least = kFarEnough;
  for (const Mover& mover : movers_) {
    const Pose2 pose = pose_at(mover.motion, time);
    for (const Convex& part : mover.parts)
      least = std::min(least, geom::separation(car, geom::placed(part, pose)).distance);
  }
  return least;
}

double Surroundings::clearance(double time, std::span<const Pose2> poses) const {
  double least = kFarEnough;
  std::vector<Convex> cars;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    cars.push_back(geom::placed({scenario_.model_of(scenario_.robots[k]).footprint, 0.0}, poses[k]));
    least = std::min(least, map_.distance(cars[k].core, kFarEnough));
    least = std::min(least, to_movers(time, cars[k]));
    for (std::size_t j = 0; j < k; ++j)
      least = std::min(least, geom::distance_up_to(cars[j].core, cars[k].core, kFarEnough));
  }
  return least;
}

}  // namespace seine::sim
