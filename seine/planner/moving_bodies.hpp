#pragma once

#include <vector>

#include "seine/traj/trajectory.hpp"
#include "seine/trajopt/proximity.hpp"
#include "seine/world/scenario.hpp"

namespace seine::planner {

/// The scenario's moving obstacles as the optimiser sees them: one convex body a part, placed at `ticks` ticks of `tick` seconds.
std::vector<trajopt::Body> moving_obstacles(const world::Scenario& scenario, double tick, int ticks);

/// A car that keeps its trajectory.
trajopt::Body driven(const traj::RobotTrajectory& trajectory, const vehicle::Model& model, double clearance, double tick,
                     int ticks);

}  // namespace seine::planner
