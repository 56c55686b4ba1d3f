#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "seine/net/flight.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::sim {

/// A curve driven along with even progress: `place(t)` for t in [0, duration], 20 pieces a second. Good
/// enough for tests: quintics through its places, velocities and accelerations.
inline traj::RobotTrajectory follow(const std::function<geom::Vec2(double)>& place, double duration) {
  constexpr double kPiece = 0.05, kStep = 1e-3;
  traj::Segment segment;
  const int pieces = static_cast<int>(std::ceil(duration / kPiece));
  segment.piece_duration = duration / pieces;
  const double h = segment.piece_duration;
  const auto knot = [&](int i) {
    const double t = std::clamp(i * h, kStep, duration - kStep);
    const geom::Vec2 before = place(t - kStep), now = place(t), after = place(t + kStep);
    const geom::Vec2 velocity = (after - before) / (2.0 * kStep);
    return std::array{place(std::clamp(i * h, 0.0, duration)), h * velocity,
                      (h * h / (kStep * kStep)) * (after - 2.0 * now + before)};
  };
  const auto quintic = [](double p0, double v0, double a0, double p1, double v1, double a1) {
    const double d = p1 - p0 - v0 - 0.5 * a0, e = v1 - v0 - a0, f = a1 - a0;
    return traj::Quintic{
        p0, v0, 0.5 * a0, 10 * d - 4 * e + 0.5 * f, -15 * d + 7 * e - f, 6 * d - 3 * e + 0.5 * f};
  };
  for (int i = 0; i < pieces; ++i) {
    const auto a = knot(i), b = knot(i + 1);
    segment.curve.push_back({quintic(a[0].x, a[1].x, a[2].x, b[0].x, b[1].x, b[2].x),
                             quintic(a[0].y, a[1].y, a[2].y, b[0].y, b[1].y, b[2].y)});
    segment.progress.push_back({static_cast<double>(i), 1.0, 0.0, 0.0, 0.0, 0.0});
  }
  return {{segment}};
}

/// From 0 to 1 with no velocity and acceleration at either end.
inline double smooth(double w) {
  w = std::clamp(w, 0.0, 1.0);
  return w * w * w * (10.0 + w * (-15.0 + 6.0 * w));
}

/// A team with a net that drives a bend of `length` (m) in `duration` (s) in unchanged formation, and throws
/// towards it.
struct Drive {
  world::Scenario scenario;
  traj::TeamTrajectory plan;
  double length = 5.0, duration = 5.0, bend = 0.6;
};

inline geom::Vec2 way(const Drive& drive, double t) {
  const double w = smooth(t / drive.duration);
  return {drive.length * w, drive.bend * smooth(w)};
}

inline Drive drive_of(int robots, double length = 5.0, double duration = 5.0, double bend = 0.6) {
  Drive drive{.length = length, .duration = duration, .bend = bend};
  world::Scenario& scenario = drive.scenario;
  scenario.name = "drive";
  scenario.bounds = {{-50.0, -50.0}, {50.0, 50.0}};
  scenario.models = {world::standard_car()};
  scenario.net = world::family_net(robots);
  for (int k = 0; k < robots; ++k) {
    const geom::Vec2 corner = 0.9 * scenario.net->rest[static_cast<std::size_t>(k)] - geom::Vec2{0.2, 0.0};
    scenario.robots.push_back({.name = "car" + std::to_string(k), .start = {corner.x, corner.y, 0.0}});
    // Cut off a moment before it rests: a curve by time has no heading at rest.
    drive.plan.robots.push_back(
        follow([&drive, corner](double t) { return corner + way(drive, t); }, drive.duration - 0.05));
  }
  scenario.delivery = net::Delivery{{length, bend}, 0.3, std::nullopt};
  return drive;
}

/// An object that falls through the middle of the net, off by `off` (m), at `time` and as fast as `velocity`.
inline net::Target throw_at(const Drive& drive, double time, geom::Vec3 velocity, geom::Vec2 off = {}) {
  constexpr double kBefore = 0.8;  // s in the air
  const geom::Vec2 middle = way(drive, time) + off;
  net::Target target;
  target.time = time - kBefore;
  const geom::Vec3 fall{0.0, 0.0, 0.5 * net::kGravity * kBefore * kBefore};
  target.position =
      geom::Vec3{middle.x, middle.y, drive.scenario.net->rim()} + (-kBefore) * velocity + (-1.0) * fall;
  target.velocity = velocity + geom::Vec3{0.0, 0.0, net::kGravity * kBefore};
  return target;
}

/// A plain tracking law (after Kanayama et al.): feed-forward, and feedback of the error in the car's frame.
/// When it fails it holds what acts.
inline Controller plain_tracker(const world::Scenario& scenario) {
  return [&scenario](std::size_t robot, const CarState& now, const Reference& reference, bool fails) {
    if (fails) return Control{{now.acceleration, now.steering}, true};
    const vehicle::Model& model = scenario.model_of(scenario.robots[robot]);
    const traj::State goal = reference.at(0.0);
    const geom::Vec2 off = goal.pose.position() - now.pose.position();
    const geom::Vec2 ahead = now.pose.direction();
    const double along = geom::dot(off, ahead), left = geom::cross(ahead, off);
    const double turn = std::sin(goal.pose.heading - now.pose.heading);
    const double direction = goal.speed >= 0.0 ? 1.0 : -1.0;
    const double curvature = goal.curvature + 4.0 * left + 3.0 * direction * turn;
    const double acceleration = goal.acceleration + 3.0 * (goal.speed - now.speed) + 3.0 * along;
    return Control{{acceleration, std::atan(model.wheelbase * curvature)}};
  };
}

}  // namespace seine::sim
