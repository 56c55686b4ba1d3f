#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

// States of every robot for other programs, evaluated from the trajectories themselves. The clock is the
// team's: every robot has a row at every k / rate up to the makespan and one at the makespan; whoever has
// arrived stands at its goal.
namespace seine::io {

/// Columns `robot,t,x,y,heading,speed,acceleration,steering` (speed signed); numbers with all their digits.
/// Throws InputError for a plan of another team, and for a rate that is none or asks for too many rows.
/// @param rate Hz
std::string states_csv(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double rate);

/// One robot in the TUM format: `t x y 0 qx qy qz qw` a line.
std::string states_tum(const traj::RobotTrajectory& robot, double makespan, double rate);

/// A CL-MAPF schedule [Wen22]: steps of 1 / rate seconds, yaw clockwise; makespan and flowtime (the sum of
/// arrivals) in seconds.
std::string clmapf_schedule(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double rate);

/// The files that export_plan writes for this name.
std::vector<std::filesystem::path> exported_files(const world::Scenario& scenario,
                                                  const std::filesystem::path& path);

/// By the name: `.csv`, `.yaml` (CL-MAPF schedule) or `.tum` (one file a robot, `out-<robot>.tum`, where
/// there are several). Returns the files written. Throws InputError for another name, a rate that is not
/// positive or more than 20 million rows.
std::vector<std::filesystem::path> export_plan(const world::Scenario& scenario,
                                               const traj::TeamTrajectory& plan, double rate,
                                               const std::filesystem::path& path);

}  // namespace seine::io
