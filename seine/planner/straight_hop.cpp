#include "seine/planner/straight_hop.hpp"

#include <algorithm>
#include <cmath>

namespace seine::planner {
namespace {

constexpr double kLongest = 0.02;  // car lengths
constexpr double kShare = 0.99;    // of the limits

bool is_straight(const search::Path& path) {
  return std::all_of(path.points.begin(), path.points.end(), [&](const search::PathPoint& point) {
    return point.curvature == 0.0 && point.gear == path.points.front().gear;
  });
}

// When the car leaves its start for good, s.
double departure(const search::TimedPath& guess) {
  double t = 0.0;
  for (const search::ProfileKnot& knot : guess.profile)
    if (knot.s <= 0.0) t = knot.t;
  return t;
}

}  // namespace

std::optional<traj::RobotTrajectory> straight_hop(const search::TimedPath& guess, const vehicle::Model& model,
                                                  double start_speed) {
  if (guess.path.points.empty() || start_speed != 0.0) return std::nullopt;
  const geom::Pose2 start = guess.path.points.front().pose;
  if (guess.stands()) return traj::RobotTrajectory::standing(start);
  const double length = guess.path.length();
  if (length > kLongest * model.length() || !is_straight(guess.path)) return std::nullopt;
  traj::Segment segment;
  segment.gear = guess.path.points.front().gear;
  segment.wait = departure(guess);
  const geom::Vec2 by = (segment.gear * length) * start.direction();
  segment.curve = {{traj::Quintic{start.x, by.x}, traj::Quintic{start.y, by.y}}};
  // u = 10 w³ − 15 w⁴ + 6 w⁵ from rest to rest: u' is at most 15/8 and u'' at most 10/√3.
  segment.progress = {traj::Quintic{0.0, 0.0, 0.0, 10.0, -15.0, 6.0}};
  const double top = segment.gear > 0 ? model.limits.speed : model.limits.reverse_speed;
  segment.piece_duration =
      std::max(1.875 * length / (kShare * top),
               std::sqrt(10.0 / std::sqrt(3.0) * length / (kShare * model.limits.acceleration)));
  return traj::RobotTrajectory{{segment}};
}

}  // namespace seine::planner
