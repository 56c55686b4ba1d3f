#pragma once

#include <vector>

#include "seine/certify/mover.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// One car's motion, cut into cells, and what is wrong with it on its own: limits, gear, an irregular curve.
struct Chart {
  Mover mover;
  bool complete = false;  ///< false: the curve is irregular or the deadline passed; the findings say so
  std::vector<Finding> findings;
};

/// Needs a well-formed trajectory. @param horizon s, not before its arrival; the car rests until then
Chart chart_of(Context& context, int robot, const traj::RobotTrajectory& trajectory, double horizon);

}  // namespace seine::certify
