#include "seine/certify/form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/certify/chunks.hpp"
#include "seine/certify/tolerances.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/world/granted_speed.hpp"

namespace seine::certify {
namespace {

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

class FormCheck {
 public:
  FormCheck(const Context& context, int robot, const traj::RobotTrajectory& trajectory)
      : context_(context),
        robot_(robot),
        asked_(context.scenario.robots[static_cast<std::size_t>(robot)]),
        granted_(granted_to(context.scenario.model_of(asked_))),
        segments_(trajectory.segments),
        stands_(trajectory.stands) {}

  std::vector<Finding> run() {
    if (stands_) {
      check_standing();
      return std::move(findings_);
    }
    double arrival = 0.0;
    check_start();
    for (const Segment& segment : segments_) {
      check_precision(segment, arrival + segment.wait);
      arrival += segment.wait + segment.duration();
    }
    check_goal(arrival);
    return std::move(findings_);
  }

 private:
  /// `value ≤ limit` or a finding; false for NaN too.
  void require(Kind kind, double time, double value, double limit, const char* what) {
    if (value <= limit) return;
    const double excess = std::isfinite(value) ? value - limit : kLargest;
    const auto [found, allowed] = told_apart(value, limit);
    findings_.push_back(
        {{kind, time, robot_, -1, value, limit,
          format("%s: %s at t = %.4f s is %s; %s is allowed", context_.robot_name(robot_).c_str(), what, time,
                 found.c_str(), allowed.c_str())},
         excess});
  }

  void check_pose(Kind kind, double time, const State& state, const geom::Pose2& wanted, const char* place,
                  const char* heading) {
    require(kind, time, geom::norm(state.pose.position() - wanted.position()), granted_.start_position,
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
    require(Kind::start, 0.0, std::abs(asked_.start_speed), granted_.rest,
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
    require(Kind::start, 0.0, std::abs((waits ? 0.0 : begin.speed) - asked), granted_.rest,
            "the difference (m/s) to its start speed");
    if (waits) {
      require(Kind::rest, segments_.front().wait, std::abs(begin.speed), granted_.rest,
              "the speed (m/s) right after a wait");
    }
  }

  void check_goal(double arrival) {
    const State end = traj::evaluate(segments_.back(), segments_.back().duration());
    if (asked_.goal) {
      check_pose(Kind::goal, arrival, end, *asked_.goal, "the distance (m) from its goal",
                 "the angle (rad) to its goal heading");
    }
    require(Kind::rest, arrival, std::abs(end.speed), granted_.rest, "the speed (m/s) on arrival");
  }

  /// Positions are sums of terms that are rounded: where the terms are huge, nobody knows them well enough.
  void check_precision(const Segment& segment, double time) {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    const auto terms = [](const Quintic& c) {
      double sum = 0.0;
      for (const double value : c) sum += std::abs(value);
      return sum;
    };
    double place = 0.0, tangent = 0.0, progress = 0.0;
    for (const auto& piece : segment.curve) {
      place = std::max(place, terms(piece[0]) + terms(piece[1]));
      tangent = std::max(tangent, longest_tangent(piece));
    }
    for (const Quintic& piece : segment.progress) progress = std::max(progress, terms(piece));
    require(Kind::malformed, time, kEpsilon * (place + tangent * progress), granted_.jump_position,
            "the rounding (m) of positions, for its coefficients are so large,");
  }

  const Context& context_;
  int robot_;
  const world::Robot& asked_;
  Granted granted_;
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
