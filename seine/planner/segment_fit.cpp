#include "seine/planner/segment_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/traj/minco.hpp"
#include "seine/trajopt/kernels.hpp"

namespace seine::planner {
namespace {

using search::Path;
using search::PathPoint;
using search::ProfileKnot;
using search::TimedPath;

// A stretch between two rests: where it lies on the path, when it is driven.
struct Stretch {
  int gear;
  double from, to;    // m along the path
  double begin, end;  // s on the clock
};

// Speeds below this share of the top speed count as standing.
constexpr double kStanding = 1e-6;

// Lengths that differ by less than this (m) are one place.
constexpr double kSameLength = 1e-9;

// Lengths at which the gear changes.
std::vector<std::pair<double, int>> gear_changes(const Path& path) {
  std::vector<std::pair<double, int>> changes{{0.0, path.points.front().gear}};
  for (std::size_t i = 1; i < path.points.size(); ++i)
    if (path.points[i].gear != changes.back().second && i + 1 < path.points.size())
      changes.emplace_back(path.points[i].s, path.points[i].gear);
  return changes;
}

// The profile's rests: length, when the car stops there, when it leaves.
struct Stop {
  double s, arrive, leave;
};

std::vector<Stop> stops_of(const TimedPath& guess, double v_max) {
  std::vector<Stop> stops;
  for (const ProfileKnot& knot : guess.profile) {
    if (knot.v > kStanding * v_max) continue;
    if (!stops.empty() && knot.s - stops.back().s < 1e-9 * (1.0 + knot.s))
      stops.back().leave = knot.t;
    else
      stops.push_back({knot.s, knot.t, knot.t});
  }
  return stops;
}

std::vector<Stretch> stretches_of(const TimedPath& guess, const vehicle::Model& model, double shortest_wait) {
  const auto gears = gear_changes(guess.path);
  const std::vector<Stop> stops = stops_of(guess, model.limits.speed);
  const double length = guess.path.length(), apart = 0.5 * model.length();
  const auto gear_at = [&](double s) {
    int gear = gears.front().second;
    for (const auto& [from, value] : gears)
      if (s >= from - 1e-9) gear = value;
    return gear;
  };
  std::vector<Stretch> stretches;
  double from = 0.0, begin = 0.0;
  for (const Stop& stop : stops) {
    if (stop.s < 1e-9) {
      begin = stop.leave;
      continue;
    }
    const bool end = stop.s > length - 1e-6;
    bool change = false;
    for (const auto& [s, gear] : gears) change = change || (s > 0.0 && std::abs(s - stop.s) < 1e-6);
    const bool wait =
        stop.leave - stop.arrive >= shortest_wait && stop.s - from > apart && length - stop.s > apart;
    if (!end && !change && !wait) continue;
    stretches.push_back({gear_at(0.5 * (from + stop.s)), from, stop.s, begin, stop.arrive});
    from = stop.s, begin = stop.leave;
    if (end) break;
  }
  return stretches;
}

double curvature_at(const Path& path, double s) {
  const auto next = std::upper_bound(path.points.begin(), path.points.end(), s,
                                     [](double value, const PathPoint& point) { return value < point.s; });
  return next == path.points.begin() ? path.points.front().curvature : std::prev(next)->curvature;
}

// Σ |Δheading| and Σ |Δφ| (steering angle) along a stretch.
struct Turning {
  double heading = 0.0, steering = 0.0;
};

Turning turning_of(const Path& path, const Stretch& stretch, double wheelbase) {
  Turning turning;
  const PathPoint* last = nullptr;
  for (const PathPoint& point : path.points) {
    if (point.s < stretch.from - 1e-9 || point.s > stretch.to + 1e-9) continue;
    if (last != nullptr) {
      turning.heading += std::abs(geom::wrap_angle(point.pose.heading - last->pose.heading));
      turning.steering +=
          std::abs(std::atan(wheelbase * point.curvature) - std::atan(wheelbase * last->curvature));
    }
    last = &point;
  }
  return turning;
}

// A maximal stretch of a path in one gear: points[first] … points[last].
struct Run {
  std::size_t first, last;
};

std::vector<Run> runs_of(const Path& path) {
  std::vector<Run> runs{{0, 0}};
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    if (path.points[i].gear != path.points[i - 1].gear) runs.push_back({i, i});
    runs.back().last = i;
  }
  return runs;
}

// When the car leaves length s for good, and when it first gets there.
double departure(const TimedPath& guess, double s) {
  double t = 0.0;
  for (const ProfileKnot& knot : guess.profile)
    if (knot.s <= s + kSameLength) t = knot.t;
  return t;
}

double arrival(const TimedPath& guess, double s) {
  for (const ProfileKnot& knot : guess.profile)
    if (knot.s >= s - kSameLength) return knot.t;
  return guess.arrival();
}

// Stretches of a few centimetres come from exact Reeds-Shepp ends. Left out, their neighbours (of one gear)
// become one stretch, and the spline takes up the difference.
TimedPath without_tiny_stretches(const TimedPath& guess, double shortest) {
  const std::vector<PathPoint>& points = guess.path.points;
  TimedPath result;
  double cut_length = 0.0, cut_time = 0.0;
  for (const Run& run : runs_of(guess.path)) {
    const double from = points[run.first].s, to = points[run.last].s;
    if (to - from < shortest) {
      cut_length += to - from;
      cut_time += arrival(guess, to) - departure(guess, from);
      continue;
    }
    for (std::size_t i = run.first; i <= run.last; ++i) {
      result.path.points.push_back(points[i]);
      result.path.points.back().s -= cut_length;
    }
    for (const ProfileKnot& knot : guess.profile) {
      if (knot.s < from - kSameLength || knot.s > to + kSameLength) continue;
      const ProfileKnot moved{knot.t - cut_time, knot.s - cut_length, knot.v};
      if (result.profile.empty() || moved.t > result.profile.back().t) result.profile.push_back(moved);
    }
  }
  return cut_length == 0.0 || result.profile.size() < 2 ? guess : result;
}

// m: what deserves a piece of the curve.
double piece_of(const vehicle::Model& model, const FitOptions& options) {
  const double speed = model.limits.speed;
  return std::max(options.piece_length * model.length(),
                  options.piece_stopping * speed * speed / model.limits.acceleration);
}

trajopt::SegmentGuess fit_stretch(const TimedPath& guess, const Stretch& stretch, const vehicle::Model& model,
                                  const FitOptions& options, double wait) {
  trajopt::SegmentGuess segment;
  const double length = stretch.to - stretch.from, t_a = model.limits.speed / model.limits.acceleration;
  segment.gear = stretch.gear;
  segment.wait = wait;
  const Turning turning = turning_of(guess.path, stretch, model.wheelbase);
  // The guess turns its wheel in no time; where that takes time, starting slow and speeding up is easy, the
  // reverse is not.
  const double steering_time =
      std::isfinite(model.limits.steering_rate) ? turning.steering / model.limits.steering_rate : 0.0;
  segment.duration = std::max(stretch.end - stretch.begin, 1e-3) + steering_time;
  segment.length = length;
  const auto pieces_for = [](double ratio, int least) {
    return std::clamp(static_cast<int>(std::lround(ratio)), least, traj::UniformMinco::kMaxPieces);
  };
  const double piece = piece_of(model, options);
  const int pieces = pieces_for(options.finer * (length / piece + turning.heading / options.piece_turn), 3);
  const int times = pieces_for(options.finer * segment.duration / (options.piece_duration * t_a), 4);
  for (int j = 0; j <= pieces; ++j)
    segment.points.push_back(search::pose_at(guess.path, stretch.from + length * j / pieces).position());
  for (int j = 0; j <= times; ++j) {
    const double t = stretch.begin + (stretch.end - stretch.begin) * j / times;
    segment.progress.push_back(std::clamp(guess.at(t).s - stretch.from, 0.0, length));
  }
  segment.progress.back() = length;
  segment.start_heading = search::pose_at(guess.path, stretch.from).heading;
  segment.end_heading = search::pose_at(guess.path, stretch.to).heading;
  // Arcs jump in curvature; the spline's end curvature is free, and half way is a good place to begin.
  const double inside = 1e-3 * length;
  segment.start_curvature = 0.5 * curvature_at(guess.path, stretch.from + inside);
  segment.end_curvature = 0.5 * curvature_at(guess.path, stretch.to - inside);
  segment.start_acceleration = segment.end_deceleration = 0.7 * model.limits.acceleration;
  return segment;
}

}  // namespace

bool too_long_to_fit(const TimedPath& guess, const vehicle::Model& model) {
  constexpr double kTwice = 2.0;  // as long as that, wider pieces still do
  const FitOptions options;
  double longest = 0.0;
  for (const Stretch& stretch : stretches_of(guess, model, std::numeric_limits<double>::infinity()))
    longest = std::max(longest, stretch.to - stretch.from);
  return longest > kTwice * traj::UniformMinco::kMaxPieces * piece_of(model, options);
}

void set_corridor(trajopt::RobotTask& task, std::span<const geom::Pose2> poses,
                  const world::Scenario& scenario, const world::StaticMap& map, const FitOptions& options) {
  const double length = task.model.length();
  task.corridor = corridor::build(poses, task.model, map,
                                  {.reach = options.corridor_reach * length,
                                   .clearance = scenario.margins.obstacle + options.corridor_slack * length});
  // In the tightest places the guess itself has no slack to give. A car that leaves the margin has less
  // still, until it is out of it.
  const double slack = options.corridor_slack * length, margin = scenario.margins.obstacle;
  const double leaving = std::max(0.0, margin - scenario.margins.leaving.value_or(margin));
  bool out = leaving <= 0.0;
  for (std::size_t i = 0; i < task.corridor.samples(); ++i) {
    out = out || task.corridor.depth[i] <= slack;
    const double give = std::min(task.corridor.depth[i], slack + (out ? 0.0 : leaving));
    for (int k = task.corridor.begin[i]; k < task.corridor.begin[i + 1]; ++k)
      task.corridor.b[static_cast<std::size_t>(k)] += give;
  }
}

trajopt::RobotTask fit(const TimedPath& timed, const world::Scenario& scenario, const world::Robot& robot,
                       const world::StaticMap& map, const FitOptions& options) {
  trajopt::RobotTask task;
  task.model = scenario.model_of(robot);
  task.start = robot.start;
  task.start_speed = robot.start_speed;
  // A short straight move may end beside the goal by as much as the certificate grants.
  if (robot.goal) task.goal = timed.path.points.back().pose;
  const double t_a = task.model.limits.speed / task.model.limits.acceleration;
  const double tiny = options.shortest_stretch * std::min(task.model.length(), timed.path.length());
  const TimedPath guess = without_tiny_stretches(timed, tiny);
  double end = 0.0;
  std::vector<geom::Pose2> poses;
  for (const Stretch& stretch : stretches_of(guess, task.model, options.shortest_wait * t_a)) {
    task.segments.push_back(fit_stretch(guess, stretch, task.model, options, stretch.begin - end));
    end = stretch.end;
    const int samples = task.segments.back().pieces() * trajopt::kCurveLanes;
    for (int k = 0; k < samples; ++k)
      poses.push_back(search::pose_at(guess.path, stretch.from + (stretch.to - stretch.from) * k / samples));
  }
  set_corridor(task, poses, scenario, map, options);
  return task;
}

}  // namespace seine::planner
