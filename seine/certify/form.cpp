#include "seine/certify/form.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/tolerances.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/world/granted_speed.hpp"

namespace seine::certify {
namespace {

using geom::Vec2;
using traj::Quintic;
using traj::Segment;
using traj::State;

// Beyond these numbers lose the digits the tolerances need; nobody drives that far or that long.
constexpr double kLargest = 1e9;    // m, or any coefficient
constexpr double kLongest = 1e7;    // s
constexpr double kShortest = 1e-6;  // s
constexpr std::size_t kMostPieces = 1u << 20;

bool sane(const Quintic& c) {
  return std::all_of(c.begin(), c.end(), [](double value) { return std::abs(value) <= kLargest; });
}

/// Value and first two derivatives at the end (w = 1) or the beginning of a quintic.
std::array<double, 3> at_end(const Quintic& c) {
  return {c[0] + c[1] + c[2] + c[3] + c[4] + c[5], c[1] + 2.0 * c[2] + 3.0 * c[3] + 4.0 * c[4] + 5.0 * c[5],
          2.0 * c[2] + 6.0 * c[3] + 12.0 * c[4] + 20.0 * c[5]};
}
std::array<double, 3> at_begin(const Quintic& c) {
  return {c[0], c[1], 2.0 * c[2]};
}

/// The curve at one side of a knot.
struct Side {
  Vec2 p, p1, p2;
  double length() const { return geom::norm(p1); }
  double curvature() const { return geom::cross(p1, p2) / std::pow(length(), 3); }
};
Side side_of(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  return {{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}};
}

double angle_between(Vec2 a, Vec2 b) {
  return std::abs(std::atan2(geom::cross(a, b), geom::dot(a, b)));
}

class FormCheck {
 public:
  FormCheck(const Context& context, int robot, const traj::RobotTrajectory& trajectory)
      : context_(context),
        robot_(robot),
        asked_(context.scenario.robots[static_cast<std::size_t>(robot)]),
        model_(context.scenario.model_of(asked_)),
        segments_(trajectory.segments),
        stands_(trajectory.stands) {}

  std::vector<Finding> run() {
    if (stands_) {
      check_standing();
      return std::move(findings_);
    }
    double begin = 0.0;
    check_start();
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (i > 0) check_junction(i, begin);
      begin += segments_[i].wait;
      check_progress(segments_[i], begin);
      check_curve(segments_[i], begin);
      begin += segments_[i].duration();
    }
    check_goal(begin);
    return std::move(findings_);
  }

 private:
  /// `value ≤ limit` or a finding; false for NaN too.
  void require(Kind kind, double time, double value, double limit, const char* what) {
    if (value <= limit) return;
    const double excess = std::isfinite(value) ? value - limit : kLargest;
    findings_.push_back({{kind, time, robot_, -1, value, limit,
                          format("%s: %s at t = %.4f s is %.3g; %.3g is allowed",
                                 context_.robot_name(robot_).c_str(), what, time, value, limit)},
                         excess});
  }

  void check_pose(Kind kind, double time, const State& state, const geom::Pose2& wanted, const char* place,
                  const char* heading) {
    require(kind, time, geom::norm(state.pose.position() - wanted.position()), tolerance::kStartPosition,
            place);
    require(kind, time, std::abs(geom::wrap_angle(state.pose.heading - wanted.heading)),
            tolerance::kStartHeading, heading);
  }

  /// A car without segments: its start is its goal, and nothing brings it to rest.
  void check_standing() {
    State still;
    still.pose = *stands_;
    check_pose(Kind::start, 0.0, still, asked_.start, "the distance (m) from its start",
               "the angle (rad) to its start heading");
    require(Kind::start, 0.0, std::abs(asked_.start_speed), tolerance::kSpeed,
            "the start speed (m/s) of a car that stands");
    if (!asked_.goal) return;
    check_pose(Kind::goal, 0.0, still, *asked_.goal, "the distance (m) from its goal",
               "the angle (rad) to its goal heading");
  }

  void check_start() {
    const State begin = traj::evaluate(segments_.front(), 0.0);
    const bool waits = segments_.front().wait > 0.0;
    check_pose(Kind::start, 0.0, begin, asked_.start, "the distance (m) from its start",
               "the angle (rad) to its start heading");
    const double asked = world::granted_speed(context_.scenario.model_of(asked_).limits, asked_.start_speed)
                             .value_or(asked_.start_speed);
    require(Kind::start, 0.0, std::abs((waits ? 0.0 : begin.speed) - asked), tolerance::kSpeed,
            "the difference (m/s) to its start speed");
    if (waits) {
      require(Kind::rest, segments_.front().wait, std::abs(begin.speed), tolerance::kSpeed,
              "the speed (m/s) right after a wait");
    }
  }

  void check_goal(double arrival) {
    const State end = traj::evaluate(segments_.back(), segments_.back().duration());
    if (asked_.goal) {
      check_pose(Kind::goal, arrival, end, *asked_.goal, "the distance (m) from its goal",
                 "the angle (rad) to its goal heading");
    }
    require(Kind::rest, arrival, std::abs(end.speed), tolerance::kSpeed, "the speed (m/s) on arrival");
  }

  void check_junction(std::size_t i, double time) {
    const Segment &before = segments_[i - 1], &after = segments_[i];
    const State a = traj::evaluate(before, before.duration()), b = traj::evaluate(after, 0.0);
    require(Kind::continuity, time, geom::norm(a.pose.position() - b.pose.position()), tolerance::kJunction,
            "the jump of the position (m) between segments");
    require(Kind::continuity, time, std::abs(geom::wrap_angle(a.pose.heading - b.pose.heading)),
            tolerance::kJunctionHeading, "the jump of the heading (rad) between segments");
    const double fastest = std::max(std::abs(a.speed), std::abs(b.speed));
    const bool at_rest = fastest <= tolerance::kSpeed;
    if (after.wait > 0.0 || before.gear != after.gear) {
      require(Kind::rest, time, fastest, tolerance::kSpeed, "the speed (m/s) where it has to be at rest");
    } else {
      require(Kind::continuity, time, std::abs(a.speed - b.speed), tolerance::kSpeed,
              "the jump of the speed (m/s) between segments");
    }
    // The front wheel may be turned at rest where there is time for it.
    const double jump = std::abs(a.curvature - b.curvature);
    const double turn =
        std::abs(std::atan(model_.wheelbase * a.curvature) - std::atan(model_.wheelbase * b.curvature));
    if (at_rest && turn <= model_.limits.steering_rate * after.wait) return;
    if (at_rest && std::isinf(model_.limits.steering_rate)) return;
    require(Kind::continuity, time, jump, tolerance::kCurvatureJump * model_.max_curvature(),
            "the jump of the curvature (1/m) between segments");
  }

  /// Joints of u(t), and that u stays on the curve at them; in between it is monotone, which the limits
  /// prove.
  void check_progress(const Segment& segment, double begin) {
    const double last = static_cast<double>(segment.curve.size());
    for (std::size_t j = 0; j < segment.progress.size(); ++j) {
      const double time = begin + segment.piece_duration * static_cast<double>(j);
      const auto here = at_begin(segment.progress[j]), end = at_end(segment.progress[j]);
      for (const double u : {here[0], end[0]}) {
        require(Kind::continuity, time, std::max(-u, u - last), tolerance::kRange,
                "how far the progress leaves its curve (pieces)");
      }
      if (j == 0) continue;
      const auto there = at_end(segment.progress[j - 1]);
      const double scale = length_at(segment, here[0]);
      require(Kind::continuity, time, scale * std::abs(here[0] - there[0]), tolerance::kJunction,
              "the jump of the position (m) between progress pieces");
      require(Kind::continuity, time, scale * std::abs(here[1] - there[1]) / segment.piece_duration,
              tolerance::kSpeed, "the jump of the speed (m/s) between progress pieces");
    }
  }

  void check_curve(const Segment& segment, double begin) {
    for (std::size_t i = 1; i < segment.curve.size(); ++i) {
      const auto &left = segment.curve[i - 1], &right = segment.curve[i];
      const Side a = side_of(at_end(left[0]), at_end(left[1])),
                 b = side_of(at_begin(right[0]), at_begin(right[1]));
      const double time = begin + time_at(segment, static_cast<double>(i));
      require(Kind::continuity, time, geom::norm(a.p - b.p), tolerance::kJunction,
              "the jump of the position (m) between curve pieces");
      require(Kind::continuity, time, angle_between(a.p1, b.p1), tolerance::kJunctionHeading,
              "the jump of the heading (rad) between curve pieces");
      require(Kind::continuity, time, std::abs(a.length() / b.length() - 1.0), tolerance::kLengthJump,
              "the relative jump of |p'| between curve pieces");
      require(Kind::continuity, time, std::abs(a.curvature() - b.curvature()),
              tolerance::kCurvatureJump * model_.max_curvature(),
              "the jump of the curvature (1/m) between curve pieces");
    }
  }

  static double length_at(const Segment& segment, double u) {
    const auto i =
        static_cast<std::size_t>(std::clamp(u, 0.0, static_cast<double>(segment.curve.size()) - 1.0));
    const double w = u - static_cast<double>(i);
    const auto slope = [w](const Quintic& c) {
      return c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5])));
    };
    return geom::norm(geom::Vec2{slope(segment.curve[i][0]), slope(segment.curve[i][1])});
  }

  /// About when u(t) passes `u` (for messages).
  static double time_at(const Segment& segment, double u) {
    std::size_t j = 0;
    while (j + 1 < segment.progress.size() && at_end(segment.progress[j])[0] < u) ++j;
    return segment.piece_duration * (static_cast<double>(j) + 0.5);
  }

  const Context& context_;
  int robot_;
  const world::Robot& asked_;
  const vehicle::Model& model_;
  const std::vector<Segment>& segments_;
  const std::optional<geom::Pose2>& stands_;  // a car that has no segments
  std::vector<Finding> findings_;
};

}  // namespace

namespace {

std::string why_no_stand(const traj::RobotTrajectory& trajectory) {
  if (!trajectory.segments.empty()) return "it has segments and also a place where it stands";
  const geom::Pose2& pose = *trajectory.stands;
  const bool sane =
      std::abs(pose.x) <= kLargest && std::abs(pose.y) <= kLargest && std::abs(pose.heading) <= kLargest;
  return sane ? "" : "a number of the pose at which it stands is not a number or too large";
}

}  // namespace

std::string why_malformed(const traj::RobotTrajectory& trajectory) {
  if (trajectory.stands) return why_no_stand(trajectory);
  if (trajectory.segments.empty()) return "it has no segments and no place where it stands";
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < trajectory.segments.size(); ++i) {
    const Segment& s = trajectory.segments[i];
    const auto complain = [i](const char* what) { return "segment " + std::to_string(i + 1) + ": " + what; };
    if (s.gear != 1 && s.gear != -1) return complain("the gear is neither 1 nor -1");
    if (!(s.wait >= 0.0 && s.wait <= kLongest))
      return complain("the wait is negative, too long or not a number");
    if (!(s.piece_duration >= kShortest && s.piece_duration <= kLongest)) {
      return complain("the piece duration is not positive, too long or not a number");
    }
    if (s.curve.empty()) return complain("the curve has no pieces");
    if (s.progress.empty()) return complain("the progress has no pieces");
    for (const auto& piece : s.curve) {
      if (!sane(piece[0]) || !sane(piece[1]))
        return complain("a curve coefficient is not a number or too large");
    }
    for (const auto& piece : s.progress) {
      if (!sane(piece)) return complain("a progress coefficient is not a number or too large");
    }
    pieces += s.curve.size() + s.progress.size();
    if (pieces > kMostPieces) return "it has too many pieces";
  }
  return {};
}

std::vector<Finding> check_form(const Context& context, int robot, const traj::RobotTrajectory& trajectory) {
  return FormCheck(context, robot, trajectory).run();
}

}  // namespace seine::certify
