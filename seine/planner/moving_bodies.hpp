#pragma once

#include <vector>

#include "seine/search/path.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/trajopt/proximity.hpp"
#include "seine/world/scenario.hpp"

namespace seine::planner {

/// The scenario's moving obstacles as the optimiser sees them: one convex body a part, placed at `ticks`
/// ticks of `tick` seconds.
/// @param slack units, on top of the scenario's margin
std::vector<trajopt::Body> moving_obstacles(const world::Scenario& scenario, const trajopt::Units& units,
                                            double slack, double tick, int ticks);

/// A car that keeps its motion, without placements yet.
trajopt::Body car_body(const vehicle::Model& model, double clearance, const trajopt::Units& units,
                       double slack);
void place(trajopt::Body& body, const traj::RobotTrajectory& trajectory, const trajopt::Units& units,
           double tick, int ticks);
void place(trajopt::Body& body, const search::TimedPath& path, const trajopt::Units& units, double tick,
           int ticks);

}  // namespace seine::planner
