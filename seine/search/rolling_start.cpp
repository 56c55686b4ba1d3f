#include "seine/search/rolling_start.hpp"

#include <cmath>
#include <cstdio>

#include "seine/search/motion.hpp"

namespace seine::search {
namespace {

// Points of a braking way at most so many car lengths apart.
constexpr double kSpacing = 0.06;
// m: the rounding of a car that stops just where it must.
constexpr double kTouch = 1e-4;

/// m straight on that are clear, at most `length`.
double clear_ahead(const RollingStart& start, double length) {
  const FootprintChecker checker(*start.map, nullptr, *start.model, start.clearance - kTouch);
  return checker.reach(start.pose, checker.room(start.pose), {0.0, start.gear() * length});
}

Path straight_on(const RollingStart& start, double length) {
  const int samples = 1 + static_cast<int>(length / (kSpacing * start.model->length()));
  Path path;
  for (int i = 0; i <= samples; ++i) {
    const double s = length * i / samples;
    path.points.push_back({s, vehicle::drive(start.pose, 0.0, start.gear() * s), 0.0, start.gear()});
  }
  return path;
}

}  // namespace

double RollingStart::braking_distance(double share) const {
  return speed * speed / (2.0 * share * model->limits.acceleration);
}

bool follows(const RollingStart& start, const Path& path, double share) {
  if (path.points.empty() || path.points.front().gear != start.gear()) return false;
  const double square = start.speed * start.speed;
  const double gain = 2.0 * share * start.model->limits.acceleration;
  for (const PathPoint& point : path.points) {
    const double least = square - gain * point.s;  // of the squared speed here
    if (least <= 0.0) return true;
    if (point.gear != start.gear()) return false;
    if (least * std::abs(point.curvature) > start.model->limits.lateral_acceleration) return false;
  }
  return false;
}

std::optional<Path> brake_straight(const RollingStart& start, double share) {
  // The profile's steps need a little more than the formula.
  double length = start.braking_distance(share) + 0.02 * start.braking_distance(1.0);
  const double within_a_step = 0.5 * std::abs(start.speed) * start.step;
  if (std::abs(start.speed) <= share * start.model->limits.acceleration * start.step) length = within_a_step;
  if (clear_ahead(start, length) < length) return std::nullopt;
  return straight_on(start, length);
}

std::optional<Path> brake_before_obstacle(const RollingStart& start, double share) {
  const double least = start.braking_distance(share);
  const double clear = clear_ahead(start, least + 0.2 * start.braking_distance(1.0));
  if (clear < least) return std::nullopt;
  return straight_on(start, clear);
}

std::string no_room_to_stop(const RollingStart& start) {
  constexpr double kAmple = 1.15;  // of the braking distance: with more than that it is not the braking
  const double needed = start.braking_distance(1.0), clear = clear_ahead(start, kAmple * needed);
  if (clear >= kAmple * needed) return {};
  char text[240];
  std::snprintf(text, sizeof text, "drives at %.2f m/s and needs %.3f m to stop; %.3f m are clear ahead%s",
                std::abs(start.speed), needed, clear,
                clear < needed ? "" : ", too little to spare for a plan; a lower speed may help");
  return text;
}

}  // namespace seine::search
