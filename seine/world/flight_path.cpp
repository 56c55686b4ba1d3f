// Conservative advancement: as long as object and obstacle are d apart and come nearer by at most V a second,
// nothing happens for d / V.
#include "seine/world/flight_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "seine/geom/convex.hpp"
#include "seine/net/flight.hpp"
#include "seine/world/check_parts.hpp"

namespace seine::world {
namespace {

using geom::Convex;
using geom::Vec2;

constexpr double kNear = 1e-4;      // m: counts as a hit
constexpr double kLeaving = 1e-3;   // s, between looks at what it was released in
constexpr int kMostSteps = 200000;  // of one obstacle; a flight that needs more all but touches it

geom::Pose2 pose_at(const std::vector<Waypoint>& motion, double t) {
  if (motion.empty()) return {};
  if (t <= motion.front().t) return motion.front().pose;
  const auto after = std::find_if(motion.begin(), motion.end(), [&](const Waypoint& w) { return w.t >= t; });
  if (after == motion.end()) return motion.back().pose;
  const Waypoint &a = *(after - 1), &b = *after;
  const double part = (t - a.t) / (b.t - a.t);
  return {a.pose.x + part * (b.pose.x - a.pose.x), a.pose.y + part * (b.pose.y - a.pose.y),
          a.pose.heading + part * geom::wrap_angle(b.pose.heading - a.pose.heading)};
}

// The fastest that any point of a moving body goes, m/s.
double top_speed(const std::vector<Waypoint>& motion, const std::vector<Convex>& body) {
  double reach = 0.0, fastest = 0.0;
  for (const Convex& part : body)
    for (const Vec2 p : part.core) reach = std::max(reach, geom::norm(p) + part.radius);
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    const geom::Pose2 &a = motion[i].pose, &b = motion[i + 1].pose;
    const double way =
        geom::norm(b.position() - a.position()) + reach * std::abs(geom::wrap_angle(b.heading - a.heading));
    fastest = std::max(fastest, way / (motion[i + 1].t - motion[i].t));
  }
  return fastest;
}

// Of a point at a height from a body that stands on the ground.
double distance_to(const std::vector<Convex>& body, const geom::Pose2& pose, double tall, geom::Vec3 p) {
  const Vec2 ground = p.ground();
  double beside = std::numeric_limits<double>::infinity();
  for (const Convex& part : body) {
    const Convex there = geom::placed(part, pose);
    beside = std::min(beside, geom::distance(std::span(&ground, 1), there.core) - there.radius);
  }
  return std::hypot(std::max(0.0, beside), std::max(0.0, p.z - tall));
}

}  // namespace

std::optional<FlightObstruction> flight_obstruction(const Scenario& scenario, const net::Target& target,
                                                    double until) {
  const net::Flight flight(target);
  // It never goes faster than gravity alone could make it.
  const double lasts = std::max(0.0, until - target.time);
  const double speed =
      std::hypot(target.velocity.x, target.velocity.y, target.velocity.z) + net::kGravity * lasts;
  std::optional<FlightObstruction> first;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    const Obstacle& obstacle = scenario.obstacles[i];
    if (!std::isfinite(obstacle.height)) continue;
    const std::vector<Convex> body = body_of(obstacle);
    const double closing = std::max(speed + top_speed(obstacle.motion, body), 1e-6);
    double t = target.time;
    bool out = false;  // of what it was released in
    for (int step = 0; t <= until; ++step) {
      const geom::Vec3 at = flight.at(t).position;
      const double left = distance_to(body, pose_at(obstacle.motion, t), obstacle.height, at) - target.radius;
      out = out || left >= kNear;
      const bool hits = out && left < kNear;
      if (hits || step >= kMostSteps) {
        if (!first || t < first->time) first = {static_cast<int>(i), t, at.z, hits};
        break;
      }
      t += out ? left / closing : kLeaving;
    }
  }
  return first;
}

std::string describe(const Scenario& scenario, const FlightObstruction& obstruction) {
  const auto index = static_cast<std::size_t>(obstruction.obstacle);
  const Obstacle& obstacle = scenario.obstacles[index];
  return "flies into " + name_of(obstacle, index) + " at t = " + number(obstruction.time) + " s, " +
         metres(obstruction.height) + " above the ground: it is " + metres(obstacle.height) + " tall";
}

}  // namespace seine::world
