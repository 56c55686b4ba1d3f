#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/world/check.hpp"
#include "seine/world/scenario.hpp"

// What `check` and `check_net` have in common.
namespace seine::world {

inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

inline std::string metres(double value) {
  return number(value) + " m";
}

inline std::string name_of(const Robot& robot, std::size_t index) {
  return robot.name.empty() ? "robot " + std::to_string(index + 1) : robot.name;
}

inline std::string name_of(const Obstacle& obstacle, std::size_t index) {
  return obstacle.name.empty() ? "obstacle " + std::to_string(index + 1) : obstacle.name;
}

/// True when `value` is fine. NaN never is; infinity only where a limit may be absent.
inline bool require(bool fine, const std::string& what, double value, const char* expected, Complaints& out) {
  if (!fine) out.push_back(what + " is " + number(value) + ", expected " + expected);
  return fine;
}

/// The same for a limit of which any finite value has a meaning for a plan that is judged.
inline bool require_limit(bool fine, const std::string& what, double value, const char* expected,
                          Complaints& out) {
  if (require(fine && std::isfinite(value), what, value, expected, out)) return true;
  out.back().judged = std::isfinite(value);
  return false;
}

/// A moving obstacle's pose at t = 0, the start of the common clock.
inline geom::Pose2 pose_at_start(const std::vector<Waypoint>& motion) {
  const auto after = std::find_if(motion.begin(), motion.end(), [](const Waypoint& w) { return w.t >= 0.0; });
  if (after == motion.begin()) return motion.front().pose;
  if (after == motion.end()) return motion.back().pose;
  const Waypoint& a = *(after - 1);
  const double part = -a.t / (after->t - a.t);
  return {a.pose.x + part * (after->pose.x - a.pose.x), a.pose.y + part * (after->pose.y - a.pose.y),
          a.pose.heading + part * geom::wrap_angle(after->pose.heading - a.pose.heading)};
}

/// Its shape as convex parts, in the frame of its shape.
inline std::vector<geom::Convex> body_of(const Obstacle& obstacle) {
  if (const auto* circle = std::get_if<Circle>(&obstacle.shape)) return {{{circle->center}, circle->radius}};
  std::vector<geom::Convex> parts;
  for (std::vector<geom::Vec2>& part :
       geom::convex_parts(std::get<std::vector<geom::Vec2>>(obstacle.shape))) {
    parts.push_back({std::move(part), 0.0});
  }
  return parts;
}

}  // namespace seine::world
