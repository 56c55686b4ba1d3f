#pragma once

#include <optional>

#include "seine/search/path.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::planner {

/// The trajectory of a car that needs no optimiser, because it stands or only rolls straight for a fiftieth
/// of its length: there is one curve for that, and what little time could be gained is lost between the
/// optimiser's tolerances. It leaves when the guess does. Nothing for any other guess, and for a car that is
/// moving at the start.
std::optional<traj::RobotTrajectory> straight_hop(const search::TimedPath& guess, const vehicle::Model& model,
                                                  double start_speed);

}  // namespace seine::planner
