#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::certify::test {

using geom::Vec2;
using traj::Quintic;

/// The quintic with these values and first two derivatives at 0 and at 1.
inline Quintic hermite(std::array<double, 3> a, std::array<double, 3> b) {
  const double c0 = a[0], c1 = a[1], c2 = 0.5 * a[2];
  const double p = b[0] - c0 - c1 - c2, v = b[1] - c1 - 2.0 * c2, w = b[2] - 2.0 * c2;
  return {c0, c1, c2, 10.0 * p - 4.0 * v + 0.5 * w, -15.0 * p + 7.0 * v - w, 6.0 * p - 3.0 * v + 0.5 * w};
}

/// A pose with the curvature of the front wheel there.
struct Bent {
  geom::Pose2 pose;
  double curvature = 0.0;
};

/// One piece of curve between two bent poses in a gear; |p'| = length at both ends, so pieces of one length
/// join C².
inline std::array<Quintic, 2> curve_piece(const Bent& from, const Bent& to, int gear, double length) {
  const auto ends = [&](const Bent& at) {
    const Vec2 d = at.pose.direction(), n = geom::left_normal(d);
    const Vec2 first = gear * length * d, second = at.curvature * length * length * n;
    return std::array<std::array<double, 3>, 2>{
        {{at.pose.x, first.x, second.x}, {at.pose.y, first.y, second.y}}};
  };
  const auto a = ends(from), b = ends(to);
  return {hermite(a[0], b[0]), hermite(a[1], b[1])};
}

/// Where a car gets over `length` when its curvature goes evenly from one value to the next.
inline Bent drive(const Bent& from, double next_curvature, int gear, double length) {
  constexpr int kSteps = 64;
  Bent at = from;
  const double ds = gear * length / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double kappa = from.curvature + (next_curvature - from.curvature) * (i + 0.5) / kSteps;
    const Vec2 d = geom::unit(at.pose.heading + 0.5 * ds * kappa);
    at.pose.x += ds * d.x, at.pose.y += ds * d.y, at.pose.heading += ds * kappa;
  }
  at.curvature = next_curvature;
  return at;
}

/// u(t) from rest to rest over `pieces`: M ((1 − cos πx)/2 + skew (1 − cos 2πx)/2), monotone for |skew| ≤
/// 1/4, interpolated by C² quintics.
inline std::vector<Quintic> rest_to_rest(double curve_pieces, int pieces, double skew) {
  const double pi = std::numbers::pi;
  const auto at = [&](int j) -> std::array<double, 3> {
    const double x = static_cast<double>(j) / pieces, step = 1.0 / pieces;
    return {curve_pieces * (0.5 * (1.0 - std::cos(pi * x)) + 0.5 * skew * (1.0 - std::cos(2.0 * pi * x))),
            curve_pieces * step * (0.5 * pi * std::sin(pi * x) + skew * pi * std::sin(2.0 * pi * x)),
            curve_pieces * step * step *
                (0.5 * pi * pi * std::cos(pi * x) + 2.0 * skew * pi * pi * std::cos(2.0 * pi * x))};
  };
  std::vector<Quintic> progress;
  for (int j = 0; j < pieces; ++j) {
    auto a = at(j), b = at(j + 1);
    if (j == 0) a[0] = a[1] = 0.0;
    if (j + 1 == pieces) b[0] = curve_pieces, b[1] = 0.0;
    progress.push_back(hermite(a, b));
  }
  return progress;
}

struct Shape {
  int segments = 1;
  int curve_pieces = 6;
  int progress_pieces = 8;
  double piece_length = 1.2;    ///< m
  double piece_duration = 1.0;  ///< s
  double curvature = 0.8;       ///< 1/m, at the knots at most
  double wait = 0.0;            ///< s, before every segment at most
};

/// A smooth way from a bent pose, segment by segment in alternating gears.
inline traj::RobotTrajectory random_way(Rng& rng, Bent at, const Shape& shape) {
  traj::RobotTrajectory way;
  int gear = rng.below(2) == 0 ? 1 : -1;
  for (int s = 0; s < shape.segments; ++s, gear = -gear) {
    traj::Segment segment;
    segment.gear = gear;
    segment.wait = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, shape.wait);
    segment.piece_duration = shape.piece_duration * rng.uniform(0.7, 1.4);
    for (int i = 0; i < shape.curve_pieces; ++i) {
      const Bent next = drive(at, rng.uniform(-shape.curvature, shape.curvature), gear, shape.piece_length);
      segment.curve.push_back(curve_piece(at, next, gear, shape.piece_length));
      at = next;
    }
    segment.progress = rest_to_rest(shape.curve_pieces, shape.progress_pieces, rng.uniform(-0.2, 0.2));
    way.segments.push_back(segment);
  }
  return way;
}

/// A car driving straight ahead (or back) from a pose.
inline traj::RobotTrajectory straight(const geom::Pose2& from, double length, double duration, int gear = 1) {
  traj::Segment segment;
  segment.gear = gear;
  const Bent a{from, 0.0}, b = drive(a, 0.0, gear, length);
  segment.curve.push_back(curve_piece(a, b, gear, length));
  segment.piece_duration = duration / 4.0;
  segment.progress = rest_to_rest(1.0, 4, 0.0);
  return {{segment}};
}

/// A car that never moves: a curve to have a heading, and a progress that stays at its beginning.
inline traj::RobotTrajectory parked(const geom::Pose2& at) {
  traj::RobotTrajectory way = straight(at, 1.0, 1.0);
  for (Quintic& piece : way.segments.front().progress) piece = {};
  return way;
}

/// Limits that hold nobody up.
inline vehicle::Model car(double length = 0.6, double width = 0.4) {
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(length, width, length / 6.0);
  model.wheelbase = 0.4;
  model.limits = {.speed = 100.0, .reverse_speed = 100.0, .acceleration = 1000.0, .steering = 1.5};
  return model;
}

/// A scenario whose starts and goals are those of the plan.
inline world::Scenario scenario_for(const traj::TeamTrajectory& plan, const vehicle::Model& model,
                                    double half_size) {
  world::Scenario scenario;
  scenario.name = "test";
  scenario.bounds = {{-half_size, -half_size}, {half_size, half_size}};
  scenario.models = {model};
  scenario.margins = {0.0, 0.0};
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const auto& way = plan.robots[k];
    scenario.robots.push_back(
        {.name = "car" + std::to_string(k), .start = way.at(0.0).pose, .goal = way.at(way.arrival()).pose});
  }
  return scenario;
}

}  // namespace seine::certify::test
