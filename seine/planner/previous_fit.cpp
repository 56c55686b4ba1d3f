#include "seine/planner/previous_fit.hpp"

#include <algorithm>
#include <cmath>

#include "seine/traj/minco.hpp"
#include "seine/trajopt/kernels.hpp"

namespace seine::planner {
namespace {

constexpr int kMostPieces =
    64;  // of a curve or a clock: more cost more than they bring on ways of a few lengths

using geom::Vec2;

// Less than this of a stretch is not worth a polynomial, s.
constexpr double kLeastTime = 0.05;
constexpr int kLengthSamples = 8;  // a piece

double value_of(const traj::Quintic& c, double w) {
  return c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5]))));
}

double slope_of(const traj::Quintic& c, double w) {
  return c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5])));
}

// u(t), t seconds after the segment began to move.
double progress_at(const traj::Segment& segment, double t) {
  const double rho =
      std::clamp(t / segment.piece_duration, 0.0, static_cast<double>(segment.progress.size()));
  const std::size_t j = std::min(static_cast<std::size_t>(rho), segment.progress.size() - 1);
  return std::clamp(value_of(segment.progress[j], rho - static_cast<double>(j)), 0.0,
                    static_cast<double>(segment.curve.size()));
}

struct CurvePoint {
  Vec2 position, slope;
};

CurvePoint curve_at(const traj::Segment& segment, double u) {
  const std::size_t i = std::min(static_cast<std::size_t>(std::max(u, 0.0)), segment.curve.size() - 1);
  const double w = u - static_cast<double>(i);
  const auto& c = segment.curve[i];
  return {{value_of(c[0], w), value_of(c[1], w)}, {slope_of(c[0], w), slope_of(c[1], w)}};
}

// What is left of one segment, the same for all cars.
struct Left {
  std::size_t segment;
  double from, to;  // s since it began to move
  double wait;      // s before it goes on
  int pieces, times;
};

std::vector<Left> what_is_left(const traj::RobotTrajectory& car, double now, const vehicle::Model& model,
                               const FitOptions& options) {
  const double t_a = model.limits.speed / model.limits.acceleration;
  std::vector<Left> left;
  double begin = 0.0;
  for (std::size_t i = 0; i < car.segments.size(); ++i) {
    const traj::Segment& segment = car.segments[i];
    begin += segment.wait;
    const double from = std::max(0.0, now - begin), to = segment.duration();
    const double wait = std::clamp(begin - now, 0.0, segment.wait);
    begin += to;
    if (to - from < kLeastTime) continue;
    const double share = 1.0 - progress_at(segment, from) / static_cast<double>(segment.curve.size());
    const auto pieces = static_cast<int>(std::lround(share * static_cast<double>(segment.curve.size())));
    const auto times = static_cast<int>(std::lround((to - from) / (options.piece_duration * t_a)));
    left.push_back(
        {i, from, to, wait, std::clamp(pieces, 3, kMostPieces), std::clamp(times, 4, kMostPieces)});
  }
  return left;
}

trajopt::SegmentGuess segment_of(const traj::Segment& segment, const Left& left) {
  trajopt::SegmentGuess guess;
  guess.gear = segment.gear, guess.wait = left.wait, guess.duration = left.to - left.from;
  const double u0 = progress_at(segment, left.from), u1 = static_cast<double>(segment.curve.size());
  guess.length = 0.0;
  const int samples = kLengthSamples * left.pieces;
  Vec2 last = curve_at(segment, u0).position;
  for (int k = 0; k <= samples; ++k) {
    const Vec2 at = curve_at(segment, u0 + (u1 - u0) * k / samples).position;
    guess.length += geom::norm(at - last);
    if (k % kLengthSamples == 0) guess.points.push_back(at);
    last = at;
  }
  for (int j = 0; j <= left.times; ++j) {
    const double u = progress_at(segment, left.from + guess.duration * j / left.times);
    guess.progress.push_back(guess.length * (u - u0) / (u1 - u0));
  }
  guess.progress.front() = 0.0, guess.progress.back() = guess.length;
  const traj::State first = traj::evaluate(segment, left.from), end = traj::evaluate(segment, left.to);
  guess.start_heading = first.pose.heading, guess.end_heading = end.pose.heading;
  guess.start_curvature = first.curvature, guess.end_curvature = end.curvature;
  guess.start_acceleration = std::max(0.1, std::abs(first.acceleration));
  guess.end_deceleration = std::max(0.1, std::abs(end.acceleration));
  return guess;
}

void add_poses(const traj::Segment& segment, const Left& left, std::vector<geom::Pose2>& poses) {
  const double u0 = progress_at(segment, left.from), u1 = static_cast<double>(segment.curve.size());
  const int samples = left.pieces * trajopt::kCurveLanes;
  for (int k = 0; k < samples; ++k) {
    const CurvePoint at = curve_at(segment, u0 + (u1 - u0) * k / samples);
    const Vec2 d = static_cast<double>(segment.gear) * at.slope;
    poses.push_back({at.position.x, at.position.y, std::atan2(d.y, d.x)});
  }
}

}  // namespace

std::vector<trajopt::RobotTask> fit_previous(const traj::TeamTrajectory& previous, double now,
                                             const world::Scenario& scenario, const world::StaticMap& map,
                                             const FitOptions& options) {
  if (previous.robots.size() != scenario.robots.size()) return {};
  const std::vector<Left> left =
      what_is_left(previous.robots.front(), now, scenario.model_of(scenario.robots.front()), options);
  std::vector<trajopt::RobotTask> tasks;
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const traj::RobotTrajectory& car = previous.robots[k];
    if (left.empty() || car.segments.size() != previous.robots.front().segments.size()) return {};
    const world::Robot& robot = scenario.robots[k];
    trajopt::RobotTask task;
    task.model = scenario.model_of(robot);
    task.start = robot.start, task.start_speed = robot.start_speed, task.goal = robot.goal;
    std::vector<geom::Pose2> poses;
    for (const Left& part : left) {
      task.segments.push_back(segment_of(car.segments[part.segment], part));
      add_poses(car.segments[part.segment], part, poses);
    }
    const trajopt::SegmentGuess& last = task.segments.back();
    poses.push_back({last.points.back().x, last.points.back().y, last.end_heading});
    // A team that has left the old plan a little starts where it is.
    task.segments.front().points.front() = robot.start.position();
    task.segments.front().start_heading = robot.start.heading;
    set_corridor(task, poses, scenario, map, options);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace seine::planner
