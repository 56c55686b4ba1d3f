#pragma once

#include <optional>
#include <vector>

#include "seine/corridor/corridor.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::trajopt {

/// The guess for one stretch in one gear, SI units.
struct SegmentGuess {
  int gear = 1;
  double wait = 0.0;               ///< s, at rest before it begins
  double duration = 1.0;           ///< s
  double length = 1.0;             ///< m
  std::vector<geom::Vec2> points;  ///< M + 1 points, equally spaced along the path: the spline's knots
  std::vector<double>
      progress;  ///< driven length (m) at the ends of its equal time pieces, from 0 to `length`
  double start_heading = 0.0, end_heading = 0.0;            ///< of the body, rad
  double start_curvature = 0.0, end_curvature = 0.0;        ///< of the front wheel, 1/m
  double start_acceleration = 1.0, end_deceleration = 1.0;  ///< m/s², magnitudes at the rests, > 0

  int pieces() const { return static_cast<int>(points.size()) - 1; }
  int time_pieces() const { return static_cast<int>(progress.size()) - 1; }
};

/// One car's share of the joint problem, SI units.
struct RobotTask {
  vehicle::Model model;
  geom::Pose2 start;
  double start_speed = 0.0;         ///< m/s, signed
  std::optional<geom::Pose2> goal;  ///< absent: the end pose is free
  bool fixed_cusps = false;         ///< gear changes stay where the guess has them
  bool fixed_waits = false;         ///< waits stay as long as in the guess
  std::vector<SegmentGuess> segments;
  /// Half-planes at every curve sample: kCurveLanes a piece, pieces of all segments in a row; where the end
  /// is free, at the end pose as well.
  corridor::Corridor corridor;
};

/// Poses at the curve samples of a guess, in the order that RobotTask::corridor wants them: corridors are
/// built around these.
std::vector<geom::Pose2> sample_poses(const SegmentGuess& segment);

/// What the problem is made dimensionless with.
struct Units {
  double length = 1.0;  ///< m
  double time = 1.0;    ///< s
};

}  // namespace seine::trajopt
