#include "seine/baseline/letter/guess.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "seine/search/motion.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/traj/minco.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Pose2;
using geom::Vec2;
using search::PathPoint;

constexpr double kTinyStretch = 0.05;  // car lengths: exact ends of Reeds-Shepp curves, left to the spline
constexpr double kTinyShare = 0.1;     // of a way that is itself so short
constexpr int kLeastPieces = 3, kMostPieces = 64;

// A stretch of the path in one gear; s counts from its own start.
struct Stretch {
  int gear;
  std::vector<PathPoint> points;
  double length() const { return points.back().s; }
};

// Neighbours that drive in one gear, once what is tiny between them is left out, become one.
std::vector<Stretch> stretches_of(const search::Path& path, double shortest) {
  std::vector<Stretch> stretches;
  std::vector<PathPoint> run;
  const auto close = [&] {
    if (run.size() > 1 && run.back().s - run.front().s >= shortest) {
      if (stretches.empty() || stretches.back().gear != run.front().gear)
        stretches.push_back({run.front().gear, {}});
      std::vector<PathPoint>& points = stretches.back().points;
      const double shift = (points.empty() ? 0.0 : points.back().s) - run.front().s;
      for (PathPoint point : run) {
        point.s += shift;
        points.push_back(point);
      }
    }
    run.clear();
  };
  for (const PathPoint& point : path.points) {
    if (!run.empty() && run.back().gear != point.gear) close();
    run.push_back(point);
  }
  close();
  return stretches;
}

Pose2 pose_on(const Stretch& stretch, double s) {
  const auto& points = stretch.points;
  const auto next = std::lower_bound(points.begin(), points.end(), s,
                                     [](const PathPoint& point, double value) { return point.s < value; });
  if (next == points.begin()) return points.front().pose;
  if (next == points.end()) return points.back().pose;
  const PathPoint &a = *std::prev(next), &b = *next;
  const double share = b.s > a.s ? (s - a.s) / (b.s - a.s) : 1.0;
  const Vec2 p = a.pose.position() + share * (b.pose.position() - a.pose.position());
  return {p.x, p.y, a.pose.heading + share * geom::wrap_angle(b.pose.heading - a.pose.heading)};
}

/// Speeds up from `rest`, drives on, slows down to `rest` again.
class Trapezoid {
 public:
  Trapezoid(double length, double rest, double top, double acceleration)
      : length_(length), rest_(rest), acceleration_(acceleration) {
    top_ = std::min(std::max(top, rest), std::sqrt(acceleration * length + rest * rest));
    ramp_ = (top_ - rest_) / acceleration_;
    ramp_length_ = 0.5 * (top_ + rest_) * ramp_;
    duration_ = 2.0 * ramp_ + (length_ - 2.0 * ramp_length_) / top_;
  }
  double duration() const { return duration_; }
  double driven(double t) const {
    if (t < ramp_) return (rest_ + 0.5 * acceleration_ * t) * t;
    const double left = duration_ - t;
    if (left < ramp_) return length_ - (rest_ + 0.5 * acceleration_ * left) * left;
    return ramp_length_ + top_ * (t - ramp_);
  }

 private:
  double length_, rest_, top_, acceleration_, ramp_, ramp_length_, duration_;
};

SegmentTask segment_of(const Stretch& stretch, const vehicle::Model& model, const Settings& settings,
                       std::vector<Pose2>& poses) {
  const vehicle::Limits& limits = model.limits;
  const double top = settings.speed_share * (stretch.gear > 0 ? limits.speed : limits.reverse_speed);
  const Trapezoid timing(stretch.length(), std::min(settings.cusp_speed, top), top,
                         settings.acceleration_share * limits.acceleration);
  const double wanted = stretch.length() / (settings.piece_length * model.length());
  const int pieces = std::clamp(static_cast<int>(std::lround(wanted)), kLeastPieces, kMostPieces);
  SegmentTask task{.gear = stretch.gear, .piece_duration = timing.duration() / pieces};
  const auto pose_at = [&](double pieces_driven) {
    return pose_on(stretch, timing.driven(pieces_driven * task.piece_duration));
  };
  for (int j = 0; j <= pieces; ++j) task.points.push_back(pose_at(j).position());
  task.start_heading = stretch.points.front().pose.heading;
  task.end_heading = stretch.points.back().pose.heading;
  task.start_speed = task.end_speed = std::min(settings.cusp_speed, top);
  for (int j = 0; j < pieces; ++j) {
    const int intervals = j == 0 || j + 1 == pieces ? settings.end_intervals : settings.intervals;
    for (int i = 0; i <= intervals; ++i) poses.push_back(pose_at(j + static_cast<double>(i) / intervals));
  }
  return task;
}

RobotTask task_of(const search::Path& path, const Pose2& end, const world::Scenario& scenario,
                  const world::Robot& robot, const world::StaticMap& map, const Settings& settings) {
  RobotTask task;
  task.model = scenario.model_of(robot);
  task.start = robot.start;
  task.free_end = !robot.goal;
  std::vector<Pose2> poses;
  const double shortest = std::min(kTinyStretch * task.model.length(), kTinyShare * path.length());
  for (const Stretch& stretch : stretches_of(path, shortest))
    task.segments.push_back(segment_of(stretch, task.model, settings, poses));
  if (task.segments.empty()) return task;
  // A car that moves at the start keeps its speed if it is not slower than the rest that is none.
  const double start_speed = task.segments.front().gear * robot.start_speed;
  task.segments.front().start_speed = std::max(task.segments.front().start_speed, start_speed);
  // Whatever was left out, the ends are exact.
  task.segments.front().points.front() = robot.start.position();
  task.segments.front().start_heading = robot.start.heading;
  task.segments.back().points.back() = end.position();
  task.segments.back().end_heading = end.heading;
  task.corridor = corridor::build(poses, task.model, map,
                                  {.reach = settings.corridor_reach * task.model.length(),
                                   .clearance = scenario.margins.obstacle + settings.slack});
  return task;
}

Vec2 attachment_of(const world::Scenario& scenario, std::size_t robot, const Pose2& pose) {
  return pose * scenario.net->attachments[robot].at;
}

// The formation of the start, turned to the delivery's heading if it has one, its middle at `middle`.
std::vector<Pose2> formation_at(const world::Scenario& scenario, Vec2 middle) {
  const std::size_t count = scenario.robots.size();
  Vec2 from, ahead;
  for (std::size_t k = 0; k < count; ++k) {
    from += attachment_of(scenario, k, scenario.robots[k].start) / static_cast<double>(count);
    ahead += scenario.robots[k].start.direction();
  }
  const auto& heading = scenario.delivery->heading;
  const double turn = heading ? *heading - std::atan2(ahead.y, ahead.x) : 0.0;
  std::vector<Pose2> poses;
  for (const world::Robot& robot : scenario.robots) {
    const Vec2 at = Pose2{middle.x, middle.y, turn} * (robot.start.position() - from);
    poses.push_back({at.x, at.y, heading ? *heading : robot.start.heading});
  }
  return poses;
}

bool have_room(const world::Scenario& scenario, const world::StaticMap& map,
               const std::vector<Pose2>& poses) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const search::FootprintChecker checker(map, nullptr, scenario.model_of(scenario.robots[k]),
                                           scenario.margins.obstacle);
    if (checker.room(poses[k]) < 0.0) return false;
  }
  return true;
}

}  // namespace

std::vector<Pose2> final_poses(const world::Scenario& scenario, const world::StaticMap& map) {
  std::vector<Pose2> poses;
  for (const world::Robot& robot : scenario.robots) poses.push_back(robot.goal.value_or(robot.start));
  const bool open =
      std::ranges::any_of(scenario.robots, [](const world::Robot& robot) { return !robot.goal; });
  if (!open || !scenario.delivery) return poses;
  // The middle of the region first, then around it.
  constexpr int kDirections = 8;
  for (const double share : {0.0, 0.5, 0.9})
    for (int i = 0; i < (share > 0.0 ? kDirections : 1); ++i) {
      const Vec2 off =
          (share * scenario.delivery->radius) * geom::unit(2.0 * std::numbers::pi * i / kDirections);
      std::vector<Pose2> moved = formation_at(scenario, scenario.delivery->center + off);
      for (std::size_t k = 0; k < moved.size(); ++k)
        if (scenario.robots[k].goal) moved[k] = *scenario.robots[k].goal;
      if (have_room(scenario, map, moved)) return moved;
    }
  return {};
}

Guess guess(const world::Scenario& scenario, const world::StaticMap& map, const Settings& settings,
            const Deadline& deadline, Workers& workers) {
  Guess result;
  const std::vector<Pose2> ends = final_poses(scenario, map);
  if (ends.empty()) {
    result.reason = "the formation of the start has no room in the delivery region";
    return result;
  }
  std::vector<std::optional<search::PathPlanner>> planners(scenario.models.size());
  for (const world::Robot& robot : scenario.robots) {
    auto& planner = planners[static_cast<std::size_t>(robot.model)];
    if (!planner) planner.emplace(map, scenario.model_of(robot));
  }
  result.robots.resize(scenario.robots.size());
  std::vector<std::optional<search::Path>> paths(scenario.robots.size());
  workers.run(static_cast<int>(paths.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const world::Robot& robot = scenario.robots[i];
    search::PathOptions options;
    options.clearance = scenario.margins.obstacle;
    options.deadline = deadline;
    world::Robot ends_there = robot;
    ends_there.goal = ends[i];
    if (ends_there.rests_at_goal()) {
      paths[i] = search::Path{{{0.0, robot.start, 0.0, 1}}};
      result.robots[i] = {.model = scenario.model_of(robot), .start = robot.start};
      return;
    }
    paths[i] = planners[static_cast<std::size_t>(robot.model)]->plan(robot.start, ends[i], options);
    if (paths[i])
      result.robots[i] = task_of(*paths[i], paths[i]->points.back().pose, scenario, robot, map, settings);
  });
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k]) continue;
    result.reason = "no path for " + scenario.robots[k].name + " alone";
    return result;
  }
  return result;
}

}  // namespace seine::baseline::letter
