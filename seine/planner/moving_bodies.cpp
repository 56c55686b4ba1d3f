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

}  // namespace

std::vector<trajopt::Body> moving_obstacles(const world::Scenario& scenario, double tick, int ticks) {
  std::vector<trajopt::Body> bodies;
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (obstacle.motion.empty()) continue;
    std::vector<geom::Convex> parts;
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape))
      parts.push_back({{circle->center}, circle->radius});
    else
      for (auto& part : geom::convex_parts(std::get<0>(obstacle.shape))) parts.push_back({std::move(part), 0.0});
    for (const geom::Convex& part : parts) {
      trajopt::Body body;
      body.vertices = static_cast<int>(part.core.size());
      body.radius = part.radius;
      body.clearance = scenario.margins.obstacle;
      for (int k = 0; k < ticks; ++k) {
        const Pose2 pose = pose_at(obstacle.motion, k * tick);
        for (const geom::Vec2 vertex : part.core) body.polygons.push_back(pose * vertex);
      }
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

trajopt::Body driven(const traj::RobotTrajectory& trajectory, const vehicle::Model& model, double clearance, double tick,
                     int ticks) {
  trajopt::Body body;
  body.vertices = static_cast<int>(model.footprint.size());
  body.clearance = clearance;
  body.robot = true;
  for (int k = 0; k < ticks; ++k) {
    const Pose2 pose = trajectory.at(k * tick).pose;
    for (const geom::Vec2 vertex : model.footprint) body.polygons.push_back(pose * vertex);
  }
  return body;
}

}  // namespace seine::planner
