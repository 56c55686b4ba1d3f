#include "seine/traj/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace seine::traj {
namespace {

using geom::Vec2;

/// A quintic's value and first three derivatives by its local parameter.
std::array<double, 4> horner(const Quintic& c, double w) {
  return {c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5])))),
          c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5]))),
          2.0 * c[2] + w * (6.0 * c[3] + w * (12.0 * c[4] + w * 20.0 * c[5])),
          6.0 * c[3] + w * (24.0 * c[4] + w * 60.0 * c[5])};
}

/// The piece of [0, count] that holds `parameter`, clamped; a knot belongs to the piece on its right.
std::size_t piece_of(double parameter, std::size_t count) {
  if (!(parameter > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(parameter, static_cast<double>(count))), count - 1);
}

/// The same pose and steering, standing still.
State at_rest(State state, double t) {
  state.t = t;
  state.speed = state.acceleration = state.lateral_acceleration = state.curvature_rate = 0.0;
  return state;
}

}  // namespace

State evaluate(const Segment& segment, double t) {
  State state;
  if (segment.curve.empty() || segment.progress.empty()) return state;
  const double h = segment.piece_duration;
  state.t = std::clamp(t, 0.0, std::max(0.0, segment.duration()));

  const double rho = state.t / h;
  const std::size_t j = piece_of(rho, segment.progress.size());
  const auto progress = horner(segment.progress[j], rho - static_cast<double>(j));
  const double u = std::clamp(progress[0], 0.0, static_cast<double>(segment.curve.size()));
  const double rate = progress[1] / h, rate2 = progress[2] / (h * h);  // u̇, ü

  const std::size_t i = piece_of(u, segment.curve.size());
  const double w = u - static_cast<double>(i);
  const auto x = horner(segment.curve[i][0], w), y = horner(segment.curve[i][1], w);
  const Vec2 p1{x[1], y[1]}, p2{x[2], y[2]}, p3{x[3], y[3]};
  const double gear = segment.gear >= 0 ? 1.0 : -1.0;
  const double m = geom::norm(p1), along = geom::dot(p1, p2), across = geom::cross(p1, p2);

  // Flat map of B: v = η m u̇, a_t = η (m ü + (p'·p''/m) u̇²), κ = η (p'×p'')/m³, a_n = κ v².
  state.pose = {x[0], y[0], geom::wrap_angle(std::atan2(gear * p1.y, gear * p1.x))};
  state.speed = gear * m * rate;
  state.acceleration = gear * (m * rate2 + along / m * rate * rate);
  state.curvature = gear * across / (m * m * m);
  state.lateral_acceleration = state.curvature * state.speed * state.speed;
  const double by_u = (geom::cross(p1, p3) - 3.0 * across * along / (m * m)) / (m * m * m);
  state.curvature_rate = gear * by_u * rate;
  return state;
}

double RobotTrajectory::arrival() const {
  double sum = 0.0;
  for (const Segment& segment : segments) sum += segment.wait + segment.duration();
  return sum;
}

State RobotTrajectory::at(double t) const {
  if (segments.empty()) {
    State still;
    still.t = t;
    if (stands) still.pose = *stands;
    return still;
  }
  if (t < 0.0) return at_rest(evaluate(segments.front(), 0.0), t);
  double begin = 0.0;
  for (const Segment& segment : segments) {
    begin += segment.wait;
    if (t < begin) return at_rest(evaluate(segment, 0.0), t);
    const double duration = segment.duration();
    if (t < begin + duration) {
      State state = evaluate(segment, t - begin);
      state.t = t;
      return state;
    }
    begin += duration;
  }
  State end = evaluate(segments.back(), segments.back().duration());
  if (t > begin) return at_rest(end, t);
  end.t = t;
  return end;
}

double TeamTrajectory::makespan() const {
  double latest = 0.0;
  for (const RobotTrajectory& robot : robots) latest = std::max(latest, robot.arrival());
  return latest;
}

TeamTrajectory shifted(TeamTrajectory plan, geom::Vec2 by) {
  for (RobotTrajectory& robot : plan.robots) {
    if (robot.stands) robot.stands->x += by.x, robot.stands->y += by.y;
    for (Segment& segment : robot.segments)
      for (auto& [x, y] : segment.curve) x[0] += by.x, y[0] += by.y;
  }
  return plan;
}

}  // namespace seine::traj
