#pragma once

#include <string>
#include <vector>

#include "seine/certify/report.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::certify {

/// Empty when the trajectory can be evaluated at all (sizes, finite numbers of sane size, positive durations,
/// a gear), otherwise what is wrong with it.
std::string why_malformed(const traj::RobotTrajectory& trajectory);

/// Start, goal and whether the numbers are precise enough. Needs a well-formed trajectory.
std::vector<Finding> check_form(const Context& context, int robot, const traj::RobotTrajectory& trajectory);

}  // namespace seine::certify
