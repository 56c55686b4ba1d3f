#pragma once

#include "seine/search/path.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::planner {

/// Drives a path of arcs exactly as it is: each arc from rest to rest at a trapezoid of speed, the wheel
/// turned while the car stands (a wait of so long where the steering rate is limited). Slower than what the
/// optimiser makes of the path, but it goes wherever the path goes, to the last millimetre, and keeps every
/// limit.
/// @param path         at least two points
/// @param start_speed  m/s, signed: a car that is moving brakes on the path's first arc
/// @return no segments where it cannot brake there
traj::RobotTrajectory drive_arcs(const search::Path& path, const vehicle::Model& model,
                                 double start_speed = 0.0);

}  // namespace seine::planner
