#pragma once

#include "seine/sim/simulation.hpp"

namespace seine::sim {

/// Throws InputError with what a caller of simulate got wrong: a scenario whose numbers make no sense, a plan
/// for another team or of cars without a way, no controller, periods and faults that cannot be.
void expect_preconditions(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                          const Controller& controller, const SimulationOptions& options);

}  // namespace seine::sim
