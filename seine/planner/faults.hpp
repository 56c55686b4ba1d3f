#pragma once

#include "seine/certify/certificate.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::planner {

/// How far a plan is from one that holds, by its worst violation: 1 is what repairs hardly ever mend
/// (10 cm of clearance, half of a limit).
double severity(const certify::Certificate& certificate);

/// Whether a curve turns back within a few centimetres, as no wheel steers: nothing is won by repairing that,
/// and proving how wrong it is takes seconds.
bool folds(const traj::RobotTrajectory& car);

/// The worst violation, measured in the same way; null when it has none.
const certify::Violation* worst(const certify::Certificate& certificate);

}  // namespace seine::planner
