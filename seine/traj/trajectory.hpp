#pragma once

#include <array>
#include <optional>
#include <vector>

#include "seine/geom/pose2.hpp"

namespace seine::traj {

/// The state of a car and its flat derivatives at one instant.
struct State {
  double t = 0.0;                     ///< s, common clock
  geom::Pose2 pose;                   ///< rear-axle middle; heading in (−π, π]
  double speed = 0.0;                 ///< v, m/s, signed: negative backwards
  double acceleration = 0.0;          ///< a_t = v̇, m/s², signed along the body's x axis
  double lateral_acceleration = 0.0;  ///< a_n = v² κ, m/s²
  double curvature = 0.0;  ///< κ = tan φ / L, 1/m, of the front wheel: positive turns the car left, in either
                           ///< gear when driving forward
  double curvature_rate = 0.0;  ///< κ̇, 1/(m s)
};

/// A polynomial Σ c[k] w^k of degree five over w ∈ [0, 1].
using Quintic = std::array<double, 6>;

/// A stretch driven in one gear: a curve p(u) traversed by the scalar u(t). p has one quintic a unit of u,
/// u(t) one quintic a `piece_duration`; the number of pieces may differ. u runs from 0 to the number of curve
/// pieces. At a rest u̇ = 0 while p' ≠ 0, so heading and curvature are defined there. See docs/trajectory.md.
struct Segment {
  int gear = 1;                               ///< η: +1 forward, −1 backward
  double wait = 0.0;                          ///< s, at rest before it starts, ≥ 0
  double piece_duration = 1.0;                ///< h, s, > 0
  std::vector<std::array<Quintic, 2>> curve;  ///< (x, y) of each piece, local parameter w = u − ⌊u⌋
  std::vector<Quintic> progress;              ///< u of each piece, local parameter w = (t − t_j) / h

  double duration() const { return piece_duration * static_cast<double>(progress.size()); }
};

/// One car's way: segments in order. Before the first it stands at its start, after the last at its goal. A
/// car without segments stands at `stands` the whole time, with its wheels straight.
struct RobotTrajectory {
  std::vector<Segment> segments;
  std::optional<geom::Pose2> stands{};  ///< where the car stands that has no segments; else absent

  /// The way of a car that never moves: it has arrived at 0 s.
  static RobotTrajectory standing(const geom::Pose2& pose) { return {{}, pose}; }
  /// When the car has come to rest for good, s: Σ (wait + duration); 0 for a car that stands.
  double arrival() const;
  /// State at time t on the common clock; before 0 and after arrival the car rests at its end poses.
  State at(double t) const;
};

/// The team on one common clock that starts at 0.
struct TeamTrajectory {
  std::vector<RobotTrajectory> robots;
  double makespan() const;  ///< s, latest arrival
};

/// The same motion `by` metres further on.
TeamTrajectory shifted(TeamTrajectory plan, geom::Vec2 by);

/// State on a segment `t` seconds after it began to move (t is clamped to [0, duration]); the result's `t` is
/// that local time.
State evaluate(const Segment& segment, double t);

}  // namespace seine::traj
