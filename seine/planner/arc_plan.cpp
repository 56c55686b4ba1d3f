#include "seine/planner/arc_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "seine/vehicle/arc.hpp"

namespace seine::planner {
namespace {

using traj::Quintic;
using vehicle::Arc;

// A quintic with the ends, tangents and curvatures of an arc of so much turn (rad) has its curvature
// everywhere to 1e-7 of it.
constexpr double kTurn = 0.1;
// Of the limits: what rounding needs.
constexpr double kKept = 1.0 - 1e-4;
// Progress pieces between speeding up and braking at most.
constexpr int kMostCruising = 48;
constexpr double kNoLength = 1e-9;       // m
constexpr double kSameCurvature = 1e-9;  // 1/m

/// The arcs that a path's labels say, and where each begins.
struct Placed {
  geom::Pose2 from;
  Arc arc;
};

std::vector<Placed> arcs_of(const search::Path& path) {
  std::vector<Placed> arcs;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const search::PathPoint &here = path.points[i], &next = path.points[i + 1];
    if (next.s - here.s < kNoLength) continue;
    const double distance = here.gear * (next.s - here.s);
    if (!arcs.empty() && arcs.back().arc.gear() == here.gear &&
        std::abs(arcs.back().arc.curvature - here.curvature) < kSameCurvature) {
      arcs.back().arc.distance += distance;
    } else {
      arcs.push_back({here.pose, {here.curvature, distance}});
    }
  }
  return arcs;
}

/// The quintic with value, first and second derivative p, v, a at w = 0 and q, u, b at w = 1.
Quintic hermite(double p, double v, double a, double q, double u, double b) {
  const double d = q - p - v - 0.5 * a, e = u - v - a, f = b - a;
  return {p, v, 0.5 * a, 10.0 * d - 4.0 * e + 0.5 * f, -15.0 * d + 7.0 * e - f, 6.0 * d - 3.0 * e + 0.5 * f};
}

std::array<Quintic, 2> curve_piece(const geom::Pose2& from, const Arc& arc) {
  const geom::Pose2 to = vehicle::drive(from, arc);
  const double length = std::abs(arc.distance), bend = arc.curvature * length * length;
  const geom::Vec2 t0 = arc.distance * from.direction(), t1 = arc.distance * to.direction();
  const geom::Vec2 n0 = bend * geom::left_normal(from.direction()),
                   n1 = bend * geom::left_normal(to.direction());
  return {hermite(from.x, t0.x, n0.x, to.x, t1.x, n1.x), hermite(from.y, t0.y, n0.y, to.y, t1.y, n1.y)};
}

/// Speeds up for one piece, cruises for `cruising` pieces, brakes for one: as quick as the limits allow.
void drive_pieces(traj::Segment& segment, double length, double speed, double acceleration) {
  const auto piece_time = [&](int cruising) {
    const double parts = 1.0 + cruising;
    return std::max(length / (parts * speed), std::sqrt(length / (parts * acceleration)));
  };
  int best = 0;
  for (int cruising = 1; cruising <= kMostCruising; ++cruising)
    if ((2 + cruising) * piece_time(cruising) < (2 + best) * piece_time(best)) best = cruising;
  segment.piece_duration = piece_time(best);
  const double pieces = static_cast<double>(segment.curve.size()), step = pieces / (1.0 + best);
  segment.progress.push_back({0.0, 0.0, 0.5 * step, 0.0, 0.0, 0.0});
  for (int i = 0; i < best; ++i) segment.progress.push_back({(i + 0.5) * step, step, 0.0, 0.0, 0.0, 0.0});
  segment.progress.push_back({pieces - 0.5 * step, step, -0.5 * step, 0.0, 0.0, 0.0});
}

/// Goes on at the speed it has and brakes in the last piece. False: the way is too short for that.
bool brake_pieces(traj::Segment& segment, double length, double speed, double acceleration) {
  const int cruising =
      std::min(kMostCruising, static_cast<int>(acceleration * length / (speed * speed) - 0.5));
  if (acceleration * length < 0.5 * speed * speed) return false;
  segment.piece_duration = length / (speed * (cruising + 0.5));
  const double step = static_cast<double>(segment.curve.size()) / (cruising + 0.5);
  for (int i = 0; i < cruising; ++i) segment.progress.push_back({i * step, step, 0.0, 0.0, 0.0, 0.0});
  segment.progress.push_back({cruising * step, step, -0.5 * step, 0.0, 0.0, 0.0});
  return true;
}

/// @param start_speed  m/s, of a car that is moving when the arc begins, else 0
std::optional<traj::Segment> drive_arc(const Placed& placed, const vehicle::Model& model,
                                       double start_speed) {
  const Arc& arc = placed.arc;
  const double length = std::abs(arc.distance), bend = std::abs(arc.curvature);
  const int pieces = std::max(1, static_cast<int>(std::ceil(bend * length / kTurn)));
  traj::Segment segment;
  segment.gear = arc.gear();
  geom::Pose2 at = placed.from;
  for (int i = 0; i < pieces; ++i) {
    const Arc part{arc.curvature, arc.distance / pieces};
    segment.curve.push_back(curve_piece(at, part));
    at = vehicle::drive(at, part);
  }
  const vehicle::Limits& limits = model.limits;
  double speed = arc.gear() > 0 ? limits.speed : limits.reverse_speed;
  if (bend > 0.0) speed = std::min(speed, std::sqrt(limits.lateral_acceleration / bend));
  const double acceleration =
      std::isfinite(limits.acceleration) ? limits.acceleration : speed * speed / length;
  if (start_speed == 0.0) {
    drive_pieces(segment, length, kKept * speed, kKept * acceleration);
    return segment;
  }
  const double rolling = start_speed * segment.gear;
  const bool follows = rolling > 0.0 && bend * rolling * rolling <= limits.lateral_acceleration;
  if (!follows || !brake_pieces(segment, length, rolling, (1.0 - 1e-7) * acceleration)) return std::nullopt;
  return segment;
}

}  // namespace

traj::RobotTrajectory drive_arcs(const search::Path& path, const vehicle::Model& model, double start_speed) {
  traj::RobotTrajectory drive;
  double steering = 0.0;
  for (const Placed& placed : arcs_of(path)) {
    std::optional<traj::Segment> driven =
        drive_arc(placed, model, drive.segments.empty() ? start_speed : 0.0);
    if (!driven) return {};
    traj::Segment segment = *std::move(driven);
    const double wanted = std::atan(model.wheelbase * placed.arc.curvature);
    // The wheel may stand in any way at first.
    if (!drive.segments.empty() && std::isfinite(model.limits.steering_rate))
      segment.wait = std::abs(wanted - steering) / (kKept * model.limits.steering_rate);
    steering = wanted;
    drive.segments.push_back(std::move(segment));
  }
  return drive;
}

}  // namespace seine::planner
