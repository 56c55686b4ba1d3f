#include "seine/traj/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "seine/traj/drive.hpp"

namespace seine::traj {
namespace {

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
  state.t = std::clamp(t, 0.0, std::max(0.0, segment.duration()));
  const double rho = state.t / segment.piece_duration;
  const std::size_t j = piece_at(rho, segment.progress.size());
  const double w = rho - static_cast<double>(j);
  const Drive drive = drive_at(segment, j, value_at(segment.progress[j], w));
  const Flow flow = drive.flow(w);
  const Rates rates = drive.rates(flow);
  state.pose = {flow.p.x, flow.p.y,
                geom::wrap_angle(std::atan2(drive.gear * flow.p1.y, drive.gear * flow.p1.x))};
  state.speed = rates.speed;
  state.acceleration = rates.acceleration;
  state.lateral_acceleration = rates.lateral_acceleration;
  state.curvature = rates.curvature;
  state.curvature_rate = rates.curvature_rate;
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
