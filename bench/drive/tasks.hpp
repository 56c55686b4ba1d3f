#pragma once

#include <cstdint>
#include <vector>

#include "seine/sim/simulation.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::bench {

/// A task with its certified plan.
struct Planned {
  std::uint64_t seed = 0;
  world::Scenario scenario;
  traj::TeamTrajectory plan;
};

/// The first `count` throws for `robots` cars that the planner certifies.
std::vector<Planned> certified_throws(int robots, int count);

/// Drives it with the trackers of the team, its seed as the seed of the noise.
sim::SimulationResult drive(const Planned& task, sim::SimulationOptions options);

}  // namespace seine::bench
