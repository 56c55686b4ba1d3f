#pragma once

#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/traj/trajectory.hpp"

// The motion as docs/plan-format.md defines it, written down a second time: nothing here calls what the
// certificate or the planner evaluate with. Of seine/traj only the plain data are read.
namespace seine::deceive {

/// One instant of one car.
struct Sight {
  double t = 0.0;               ///< s, common clock
  double x = 0.0, y = 0.0;      ///< m
  double heading = 0.0;         ///< rad, in (−π, π]
  double speed = 0.0;           ///< m/s, signed: negative backwards
  double rate = 0.0;            ///< m/s, |p'| u̇: negative against the gear
  double acceleration = 0.0;    ///< m/s²
  double lateral = 0.0;         ///< m/s²
  double curvature = 0.0;       ///< 1/m
  double curvature_rate = 0.0;  ///< 1/(m s)
  double tangent = 0.0;         ///< m, |p'|
  bool jump = false;            ///< the same instant as the sight before it, on the other side of a joint
};

/// Where the documented formula has the car `w` into progress piece `j`.
/// @param piece the curve piece to evaluate on; −1: the documented one
Sight sight(const traj::Segment& segment, std::size_t j, double w, int piece = -1);

/// The progress u there.
double progress(const traj::Segment& segment, std::size_t j, double w);

/// The pose at time t on the common clock, as the documented `robot_state` has it.
geom::Pose2 pose_at(const traj::RobotTrajectory& way, double t);

/// How densely a car is looked at.
struct Look {
  double hertz = 1000.0;         ///< at least
  double per_piece = 64.0;       ///< sights a unit of u, at least
  int least = 12;                ///< sights a progress piece, at least
  std::size_t most = 3'000'000;  ///< sights of one car; a plan that needs more is looked at less densely
};

/// The car from its start to its arrival, in time; both sides of every joint of the progress and of every
/// knot it passes.
std::vector<Sight> track(const traj::RobotTrajectory& way, const Look& look);

}  // namespace seine::deceive
