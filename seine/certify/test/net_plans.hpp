#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "seine/certify/certificate.hpp"
#include "seine/certify/test/plans.hpp"
#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"

namespace seine::certify::test {

/// A team with its net and its plan.
struct NetTeam {
  world::Scenario scenario;
  traj::TeamTrajectory plan;

  net::Net& net() { return *scenario.net; }
  Certificate judge(const Options& options = {}) const {
    return certify(scenario, world::StaticMap(scenario), plan, options);
  }
};

/// A regular polygon with this distance from its middle to its corners.
inline std::vector<Vec2> regular(int corners, double radius, double turned = 0.0) {
  std::vector<Vec2> polygon;
  for (int k = 0; k < corners; ++k)
    polygon.push_back(radius * geom::unit(turned + 2.0 * std::numbers::pi * k / corners));
  return polygon;
}

/// A net and limits that hold nobody up, starts and goals of the plan; tests then tighten what they look at.
inline NetTeam net_team(traj::TeamTrajectory plan, std::vector<Vec2> rest, Vec2 held_at) {
  NetTeam team{scenario_for(plan, car(), 1000.0), std::move(plan)};
  team.scenario.models[0].limits = {
      .speed = 1e3, .reverse_speed = 1e3, .acceleration = 1e6, .steering = 1.57};
  team.scenario.margins = {-100.0, -100.0};
  net::Net net;
  net.attachments.assign(rest.size(), {.at = held_at, .height = 1.0});
  net.rest = std::move(rest);
  net.stretch = 10.0;
  net.clearance = -100.0;
  team.scenario.net = std::move(net);
  return team;
}

/// Every car parks, its attachment at its corner.
inline NetTeam parked_team(const std::vector<Vec2>& corners, std::vector<Vec2> rest) {
  traj::TeamTrajectory plan;
  for (const Vec2 corner : corners) plan.robots.push_back(parked({corner.x - 0.2, corner.y, 0.0}));
  return net_team(std::move(plan), std::move(rest), {0.2, 0.0});
}

/// Every car drives straight ahead along x, its attachment at its corner when it starts.
inline NetTeam driving_team(const std::vector<Vec2>& corners, std::vector<Vec2> rest, double length,
                            double duration) {
  traj::TeamTrajectory plan;
  for (const Vec2 corner : corners)
    plan.robots.push_back(straight({corner.x - 0.2, corner.y, 0.0}, length, duration));
  return net_team(std::move(plan), std::move(rest), {0.2, 0.0});
}

/// How a random team moves.
struct Motion {
  int corners = 4;
  double radius = 1.4;    ///< m, of the net at rest
  double scale = 0.9;     ///< of the attachments' polygon at the start
  double deform = 0.1;    ///< m, by which the cars leave their places in the formation
  double duration = 2.0;  ///< s
  double piece_length = 1.0;
};

/// Copies of one bent way, one for each corner, that drift in and out of their places; one gear.
inline NetTeam random_team(Rng& rng, const Motion& motion) {
  constexpr int kPieces = 3;
  const int gear = rng.below(4) == 0 ? -1 : 1;
  Bent at{{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)}, rng.uniform(-0.2, 0.2)};
  std::vector<Bent> knots{at};
  for (int i = 0; i < kPieces; ++i)
    knots.push_back(at = drive(at, rng.uniform(-0.3, 0.3), gear, motion.piece_length));
  const double skew = rng.uniform(-0.15, 0.15);
  const Vec2 held_at{rng.uniform(-0.6, 0.4), rng.uniform(-0.2, 0.2)};
  const std::vector<Vec2> rest = regular(motion.corners, motion.radius, rng.uniform(0.0, 1.0));
  traj::TeamTrajectory plan;
  for (const Vec2 corner : rest) {
    traj::Segment segment;
    segment.gear = gear;
    std::vector<Bent> own = knots;
    for (Bent& knot : own) {
      knot.pose.x += motion.scale * corner.x + rng.uniform(-motion.deform, motion.deform);
      knot.pose.y += motion.scale * corner.y + rng.uniform(-motion.deform, motion.deform);
    }
    for (std::size_t i = 0; i < kPieces; ++i)
      segment.curve.push_back(curve_piece(own[i], own[i + 1], gear, motion.piece_length));
    const int pieces = 4 + rng.below(3);
    segment.piece_duration = motion.duration / pieces;
    segment.progress = rest_to_rest(kPieces, pieces, skew + rng.uniform(-0.02, 0.02));
    plan.robots.push_back({{segment}});
  }
  return net_team(std::move(plan), rest, held_at);
}

/// The attachments of a plan, straight from the trajectories, on a grid of 10 kHz.
class Grid {
 public:
  static constexpr double kRate = 10000.0;

  explicit Grid(const NetTeam& team, double from = 0.0, double to = -1.0) : team_(team), from_(from) {
    const double end = to < 0.0 ? team.plan.makespan() : to;
    const int count = static_cast<int>((end - from) * kRate) + 1;
    for (int i = 0; i <= count; ++i) corners_.push_back(at(from + i / kRate));
  }

  std::vector<Vec2> at(double t) const {
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k < team_.plan.robots.size(); ++k) {
      corners.push_back(team_.plan.robots[k].at(t).pose * team_.scenario.net->attachments[k].at);
    }
    return corners;
  }

  using Function = std::function<double(const std::vector<Vec2>&, double)>;
  /// The smallest value of f(attachments, t): every `stride`-th point of the grid, and finer around the best.
  double least(const Function& f, std::size_t stride = 1) const {
    double best = std::numeric_limits<double>::infinity(), when = from_;
    for (std::size_t i = 0; i < corners_.size(); i += stride) {
      const double t = from_ + static_cast<double>(i) / kRate, value = f(corners_[i], t);
      if (value < best) best = value, when = t;
    }
    const double step = static_cast<double>(stride) / (100.0 * kRate);
    for (int i = -100; i <= 100; ++i) {
      const double t = std::max(from_, when + i * step);
      best = std::min(best, f(at(t), t));
    }
    return best;
  }

 private:
  const NetTeam& team_;
  double from_;
  std::vector<std::vector<Vec2>> corners_;
};

/// The least distance of an attachment inside the lines through the ring edges next to its own, m.
inline double least_corner(const std::vector<Vec2>& at) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t n = at.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 edge = at[(i + 1) % n] - at[i];
    for (const std::size_t j : {(i + 2) % n, (i + n - 1) % n})
      least = std::min(least, geom::cross(edge, at[j] - at[i]) / geom::norm(edge));
  }
  return least;
}

/// An object that falls straight down onto `place`, released at rest relative to the ground so that it passes
/// the rim (1 m up) at `time` with this speed.
inline net::Target drop(Vec2 place, double time, double speed) {
  net::Target target;
  target.time = std::max(0.0, time - 0.05);
  const double fall = time - target.time, begin = speed - 9.80665 * fall;
  target.position = {place.x, place.y, 1.0 + begin * fall + 0.5 * 9.80665 * fall * fall};
  target.velocity = {0.0, 0.0, -begin};
  return target;
}

}  // namespace seine::certify::test
