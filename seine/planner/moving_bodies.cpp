#include "seine/planner/moving_bodies.hpp"

#include <algorithm>

#include "seine/geom/polygon.hpp"

namespace seine::planner {
namespace {

using geom::Pose2;

Pose2 pose_at(const std::vector<world::Waypoint>& motion, double t) {
  if (t <= motion.front().t) return motion.front().pose;
  if (t >= motion.back().t) return motion.back().pose;
  const auto next = std::upper_bound(motion.begin(), motion.end(), t,
                                     [](double value, const world::Waypoint& w) { return value < w.t; });
  const world::Waypoint &a = *std::prev(next), &b = *next;
  const double r = (t - a.t) / (b.t - a.t);
  return {a.pose.x + r * (b.pose.x - a.pose.x), a.pose.y + r * (b.pose.y - a.pose.y),
          a.pose.heading + r * geom::wrap_angle(b.pose.heading - a.pose.heading)};
}

trajopt::Placement placed(const Pose2& pose, const trajopt::Units& units) {
  return {pose.position() / units.length, pose.direction()};
}

}  // namespace

std::vector<trajopt::Body> moving_obstacles(const world::Scenario& scenario, const trajopt::Units& units,
                                            double slack, double tick, int ticks) {
  std::vector<trajopt::Body> bodies;
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (world::stands_still(obstacle)) continue;
    std::vector<geom::Convex> parts;
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape))
      parts.push_back({{circle->center}, circle->radius});
    else
      for (auto& part : geom::convex_parts(std::get<0>(obstacle.shape)))
        parts.push_back({std::move(part), 0.0});
    for (const geom::Convex& part : parts) {
      trajopt::Body body;
      body.shape = trajopt::shape_of(part.core, units.length);
      body.radius = part.radius / units.length;
      body.clearance = scenario.margins.obstacle / units.length + slack;
      for (int k = 0; k < ticks; ++k)
        body.placements.push_back(placed(pose_at(obstacle.motion, k * tick), units));
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

trajopt::Body car_body(const vehicle::Model& model, double clearance, const trajopt::Units& units,
                       double slack) {
  trajopt::Body body;
  body.shape = trajopt::shape_of(model.footprint, units.length);
  body.clearance = clearance / units.length + slack;
  return body;
}

void place(trajopt::Body& body, const traj::RobotTrajectory& trajectory, const trajopt::Units& units,
           double tick, int ticks) {
  body.placements.clear();
  const double arrival = trajectory.arrival();
  for (int k = 0; k < ticks; ++k) {
    body.placements.push_back(placed(trajectory.at(k * tick).pose, units));
    if (k * tick > arrival) break;  // it rests there for good
  }
}

void place(trajopt::Body& body, const search::TimedPath& path, const trajopt::Units& units, double tick,
           int ticks) {
  body.placements.clear();
  const double arrival = path.arrival();
  for (int k = 0; k < ticks; ++k) {
    body.placements.push_back(placed(search::pose_at(path.path, path.at(k * tick).s), units));
    if (k * tick > arrival) break;
  }
}

}  // namespace seine::planner
