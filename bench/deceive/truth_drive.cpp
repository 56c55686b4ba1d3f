// What one car does: limits at every instant, and what its joints add up to.
#include <algorithm>
#include <cmath>

#include "bench/deceive/truth.hpp"

namespace seine::deceive {
namespace {

/// How far Q rises beyond what is allowed in any window: max over i ≤ j of (Q_j − Q_i) − (A_j − A_i), A being
/// what is allowed in all until then. Both signs at once.
class Window {
 public:
  /// @return the largest excess so far of a window that ends here
  double next(double value, double allowed) {
    if (first_) low_ = value - allowed, high_ = value + allowed, first_ = false;
    const double excess = std::max(value - allowed - low_, high_ - value - allowed);
    low_ = std::min(low_, value - allowed);
    high_ = std::max(high_, value + allowed);
    return excess;
  }

 private:
  bool first_ = true;
  double low_ = 0.0, high_ = 0.0;
};

/// A limit as it counts over windows: a look between two sights is off by their distance squared.
constexpr double kWindowRoom = 1.0 + 2e-4;

class DriveLook {
 public:
  DriveLook(const vehicle::Model& model, const Grants& grants, Ledger& ledger)
      : limits_(model.limits),
        wheelbase_(model.wheelbase),
        scale_(scale_of(model, grants)),
        fastest_(std::max(model.limits.speed, model.limits.reverse_speed)),
        bend_(std::tan(model.limits.steering) / model.wheelbase),
        grants_(grants),
        ledger_(ledger) {}

  double rest() const { return std::max(1e-9, grants_.rest * scale_.pace); }

  void run(const std::vector<Sight>& track) {
    heading_ = track.empty() ? 0.0 : track.front().heading;
    for (std::size_t i = 0; i < track.size(); ++i) {
      at_instant(track[i]);
      if (i > 0) between(track[i - 1], track[i]);
    }
  }

 private:
  double wheel(const Sight& s) const { return std::atan(wheelbase_ * s.curvature); }

  void limit(const char* what, double t, double value, double most) {
    if (std::isinf(most)) return;
    ledger_.offer(what, t, value, most, grants_.limit * most + grants_.limit_floor);
  }

  void at_instant(const Sight& s) {
    if (s.rate >= 0.0) {  // else it counts as driven against the gear, below
      limit("speed (m/s)", s.t, s.speed, limits_.speed);
      limit("reverse speed (m/s)", s.t, -s.speed, limits_.reverse_speed);
    }
    limit("acceleration (m/s2)", s.t, std::abs(s.acceleration), limits_.acceleration);
    limit("lateral acceleration (m/s2)", s.t, std::abs(s.lateral), limits_.lateral_acceleration);
    limit("curvature (1/m)", s.t, std::abs(s.curvature), bend_);
    const double z = wheelbase_ * s.curvature;
    limit("steering rate (rad/s)", s.t, std::abs(wheelbase_ * s.curvature_rate / (1.0 + z * z)),
          limits_.steering_rate);
    ledger_.offer("speed against the gear (m/s)", s.t, -s.rate, 0.0, rest());
    ledger_.offer("no tangent: 1/|p'| (1/m)", s.t, 1.0 / s.tangent, 0.0, 1e9 / scale_.size);
  }

  void jumped(const Sight& a, const Sight& b, double step) {
    slipped_ += step;
    swung_ += std::abs(geom::wrap_angle(b.heading - a.heading));
    ledger_.offer("jumps of the position in all (m)", b.t, slipped_, 0.0, grants_.slip * scale_.size + 1e-12);
    ledger_.offer("jumps of the heading in all (rad)", b.t, swung_, 0.0, grants_.turn);
  }

  void between(const Sight& a, const Sight& b) {
    const double dt = b.t - a.t, step = std::hypot(b.x - a.x, b.y - a.y);
    path_ += step;
    heading_ += geom::wrap_angle(b.heading - a.heading);
    if (b.jump) jumped(a, b, step);
    if (a.rate < 0.0 && b.rate < 0.0) backed_ += step;
    const double fast = std::max(std::abs(a.speed), std::abs(b.speed));
    const double slow = std::min(std::abs(a.speed), std::abs(b.speed));
    surge_allowed_ += limits_.acceleration * dt * kWindowRoom;
    drive_allowed_ += fastest_ * dt * kWindowRoom;
    const double bends = bend_ * (b.jump ? 0.0 : step);
    const bool swerves = slow > 0.0 && !std::isinf(limits_.lateral_acceleration);
    turn_allowed_ +=
        (swerves ? std::min(bends, limits_.lateral_acceleration / slow * dt) : bends) * kWindowRoom;
    steer(a, b, dt, fast);
    const double t = b.t;
    ledger_.offer("driven against the gear in all (m)", t, backed_, 0.0, grants_.backing * scale_.size);
    ledger_.offer("driven beyond the speed limit (m)", t, far_.next(path_, drive_allowed_), 0.0,
                  grants_.window * grants_.slip * scale_.size + 1e-9);
    ledger_.offer("turned beyond the curvature or the lateral limit (rad)", t,
                  turn_.next(heading_, turn_allowed_), 0.0, grants_.window * grants_.turn);
    ledger_.offer("speed gained beyond the acceleration (m/s)", t, surge_.next(b.speed, surge_allowed_), 0.0,
                  grants_.window * grants_.surge * scale_.pace + 1e-9);
    ledger_.offer("wheel turned beyond its rate (rad)", t, wheel_.next(steered_, steer_allowed_), 0.0,
                  grants_.window * grants_.steer * bend_ * wheelbase_);
  }

  /// A car at rest may turn its wheel as fast as it can; without a limit of the rate, in no time.
  void steer(const Sight& a, const Sight& b, double dt, double fast) {
    const bool unlimited = std::isinf(limits_.steering_rate);
    const double change = wheel(b) - wheel(a);
    if (!unlimited) {
      steered_ += change;
      steer_allowed_ += limits_.steering_rate * dt * kWindowRoom;
    } else if (b.jump && fast > rest()) {
      steered_ += std::abs(change);
    }
  }

  const vehicle::Limits& limits_;
  double wheelbase_;
  Scale scale_;
  double fastest_, bend_;
  const Grants& grants_;
  Ledger& ledger_;
  double path_ = 0.0, heading_ = 0.0, slipped_ = 0.0, swung_ = 0.0, backed_ = 0.0, steered_ = 0.0;
  double surge_allowed_ = 0.0, drive_allowed_ = 0.0, turn_allowed_ = 0.0, steer_allowed_ = 0.0;
  Window far_, turn_, surge_, wheel_;
};

void look_at_end(const char* place, const char* turn, double t, const geom::Pose2& is,
                 const geom::Pose2& wanted, double size, const Grants& grants, Ledger& ledger) {
  ledger.offer(place, t, std::hypot(is.x - wanted.x, is.y - wanted.y), 0.0, grants.place * size);
  ledger.offer(turn, t, std::abs(geom::wrap_angle(is.heading - wanted.heading)), 0.0, grants.heading);
}

/// Where the car must be at rest: on arrival, at changes of the gear, before and after waits.
void look_at_rests(const std::vector<Sight>& track, const traj::RobotTrajectory& way, double granted,
                   Ledger& ledger) {
  const char* what = "speed where it has to be at rest (m/s)";
  ledger.offer(what, track.back().t, std::abs(track.back().speed), 0.0, granted);
  double begin = 0.0;
  for (std::size_t n = 0; n < way.segments.size(); ++n) {
    const traj::Segment& segment = way.segments[n];
    const bool rests = segment.wait > 0.0 || (n > 0 && way.segments[n - 1].gear != segment.gear);
    if (rests) {
      ledger.offer(what, begin + segment.wait, std::abs(sight(segment, 0, 0.0).speed), 0.0, granted);
      if (n > 0) {
        const auto& before = way.segments[n - 1];
        ledger.offer(what, begin, std::abs(sight(before, before.progress.size() - 1, 1.0).speed), 0.0,
                     granted);
      }
    }
    begin += segment.wait + segment.piece_duration * static_cast<double>(segment.progress.size());
  }
}

}  // namespace

void look_at_drive(const world::Scenario& scenario, int robot, const traj::RobotTrajectory& way,
                   const std::vector<Sight>& track, const Grants& grants, Ledger& ledger) {
  const world::Robot& asked = scenario.robots[static_cast<std::size_t>(robot)];
  const vehicle::Model& model = scenario.model_of(asked);
  DriveLook drive(model, grants, ledger);
  const double size = scale_of(model, grants).size;
  const geom::Pose2 first = pose_at(way, 0.0);
  look_at_end("distance from the start (m)", "angle to the start (rad)", 0.0, first, asked.start, size,
              grants, ledger);
  const double end = track.empty() ? 0.0 : track.back().t;
  if (asked.goal)
    look_at_end("distance from the goal (m)", "angle to the goal (rad)", end, pose_at(way, end + 1.0),
                *asked.goal, size, grants, ledger);
  const double speed = track.empty() ? 0.0 : track.front().speed;
  // A start speed a little over the limit means the limit (docs/certificate.md).
  const double most = asked.start_speed < 0.0 ? model.limits.reverse_speed : model.limits.speed;
  const double wanted = std::copysign(std::min(std::abs(asked.start_speed), most), asked.start_speed);
  ledger.offer("difference to the start speed (m/s)", 0.0, std::abs(speed - wanted), 0.0, drive.rest());
  if (track.empty()) return;
  drive.run(track);
  look_at_rests(track, way, drive.rest(), ledger);
}

}  // namespace seine::deceive
