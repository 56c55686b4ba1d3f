#include "seine/planner/formation_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "seine/traj/minco.hpp"
#include "seine/trajopt/kernels.hpp"

namespace seine::planner {
namespace {

constexpr int kMostPieces =
    64;  // of a curve or a clock: more cost more than they bring on ways of a few lengths

using geom::Pose2;
using geom::Vec2;

// A stretch of the way in one gear.
struct Stretch {
  int gear;
  double from, to;    // m
  double begin, end;  // s
  int pieces, times;
};

std::vector<Stretch> stretches_of(const FormationGuess& guess, const vehicle::Model& model,
                                  const FitOptions& options) {
  const auto& points = guess.way.path.points;
  const search::TimedPath timed{guess.way.path, guess.timing.profile};
  const double t_a = model.limits.speed / model.limits.acceleration;
  const auto pieces_for = [](double ratio, int least) {
    return std::clamp(static_cast<int>(std::lround(ratio)), least, kMostPieces);
  };
  const auto time_of = [&](double s) {
    for (const search::ProfileKnot& knot : timed.profile)
      if (knot.s >= s - 1e-9) return knot.t;
    return timed.arrival();
  };
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i + 1 < points.size();) {
    std::size_t last = i;
    double turn = 0.0;
    while (last + 1 < points.size() && points[last + 1].gear == points[i].gear) {
      ++last;
      turn += std::abs(geom::wrap_angle(points[last].pose.heading - points[last - 1].pose.heading));
    }
    Stretch s{points[i].gear, points[i].s, points[last].s, 0.0, 0.0, 0, 0};
    s.begin = time_of(s.from), s.end = std::max(time_of(s.to), s.begin + 1e-3);
    s.pieces =
        pieces_for((s.to - s.from) / (options.piece_length * model.length()) + turn / options.piece_turn, 4);
    s.times = pieces_for((s.end - s.begin) / (options.piece_duration * t_a), 5);
    if (s.to - s.from > 1e-9) stretches.push_back(s);
    i = last + 1;
  }
  return stretches;
}

double curvature_at(const search::Path& path, double s) {
  double curvature = path.points.front().curvature;
  for (const search::PathPoint& point : path.points)
    if (point.s <= s) curvature = point.curvature;
  return curvature;
}

// One car's share of a stretch.
class Fit {
 public:
  Fit(const FormationGuess& guess, std::size_t car, const world::Robot& robot)
      : guess_(guess), timed_{guess.way.path, guess.timing.profile}, car_(car), robot_(robot) {}

  Vec2 position(double s) const {
    return search::pose_at(timed_.path, s).position() + guess_.offset(car_, s);
  }

  trajopt::SegmentGuess segment(const Stretch& stretch, const vehicle::Model& model, bool first,
                                bool last) const {
    trajopt::SegmentGuess out;
    out.gear = stretch.gear;
    out.duration = stretch.end - stretch.begin;
    const double length = stretch.to - stretch.from;
    double own = 0.0, common = 0.0;
    for (int j = 0; j <= stretch.pieces; ++j) {
      const double s = stretch.from + length * j / stretch.pieces;
      out.points.push_back(position(s));
      if (j == 0) continue;
      const double before = stretch.from + length * (j - 1) / stretch.pieces;
      own +=
          geom::norm(out.points[static_cast<std::size_t>(j)] - out.points[static_cast<std::size_t>(j) - 1]);
      common += geom::norm(search::pose_at(timed_.path, s).position() -
                           search::pose_at(timed_.path, before).position());
    }
    const double stretchiness = common > 1e-9 ? own / common : 1.0;
    out.length = length * stretchiness;
    for (int j = 0; j <= stretch.times; ++j) {
      const double t = stretch.begin + out.duration * j / stretch.times;
      out.progress.push_back(std::clamp(timed_.at(t).s - stretch.from, 0.0, length) * stretchiness);
    }
    out.progress.front() = 0.0, out.progress.back() = out.length;
    out.start_heading =
        first ? robot_.start.heading : search::pose_at(timed_.path, stretch.from + 1e-6).heading;
    out.end_heading = search::pose_at(timed_.path, stretch.to).heading;
    if (first) out.points.front() = robot_.start.position(), out.wait = guess_.timing.wait;
    if (last && robot_.goal)
      out.points.back() = robot_.goal->position(), out.end_heading = robot_.goal->heading;
    const double inside = 1e-3 * length;
    out.start_curvature = 0.5 * curvature_at(timed_.path, stretch.from + inside);
    out.end_curvature = 0.5 * curvature_at(timed_.path, stretch.to - inside);
    out.start_acceleration = out.end_deceleration = 0.7 * model.limits.acceleration;
    return out;
  }

 private:
  const FormationGuess& guess_;
  search::TimedPath timed_;
  std::size_t car_;
  const world::Robot& robot_;
};

}  // namespace

Vec2 FormationGuess::offset(std::size_t k, double s) const {
  Vec2 offset = shapes.front().offsets[k];
  for (std::size_t i = 0; i < changes.size() && s > changes[i].begin; ++i) {
    const double r = std::min((s - changes[i].begin) / (changes[i].end - changes[i].begin), 1.0);
    const double share = r * r * (3.0 - 2.0 * r);
    offset = (1.0 - share) * offset + share * shapes[i + 1].offsets[k];
  }
  return offset;
}

std::vector<trajopt::RobotTask> fit_formation(const FormationGuess& guess, const world::Scenario& scenario,
                                              const world::StaticMap& map, const FitOptions& options) {
  const std::vector<Stretch> stretches =
      stretches_of(guess, scenario.model_of(scenario.robots.front()), options);
  std::vector<trajopt::RobotTask> tasks;
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const world::Robot& robot = scenario.robots[k];
    const Fit fit(guess, k, robot);
    trajopt::RobotTask task;
    task.model = scenario.model_of(robot);
    task.start = robot.start, task.start_speed = robot.start_speed, task.goal = robot.goal;
    std::vector<Pose2> poses;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& stretch = stretches[i];
      task.segments.push_back(fit.segment(stretch, task.model, i == 0, i + 1 == stretches.size()));
      std::ranges::move(trajopt::sample_poses(task.segments.back()), std::back_inserter(poses));
    }
    const trajopt::SegmentGuess& last = task.segments.back();
    poses.push_back({last.points.back().x, last.points.back().y, last.end_heading});
    set_corridor(task, poses, scenario, map, options);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace seine::planner
