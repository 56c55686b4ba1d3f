#pragma once

#include <vector>

#include "seine/planner/segment_fit.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::planner {

/// What is left of an earlier plan from `now` (s on its clock) on, as the guess for a new one whose clock
/// starts then and whose robots start as the scenario says. Empty when nothing worth keeping is left. Needs a
/// plan whose robots share one timing, as a team with a net has.
std::vector<trajopt::RobotTask> fit_previous(const traj::TeamTrajectory& previous, double now,
                                             const world::Scenario& scenario, const world::StaticMap& map,
                                             const FitOptions& options);

}  // namespace seine::planner
