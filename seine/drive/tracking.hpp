#pragma once

#include "seine/mpc/options.hpp"
#include "seine/sim/noise.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/world/scenario.hpp"

namespace seine::drive {

/// What the trackers of a team in a world of `noise` are set to: they know the lag of the actuators. The dead
/// time is not theirs to know: sim::Car asks them for where the car will be when a command takes effect.
mpc::Options tracking_options(const sim::Noise& noise);

/// A model predictive tracker for each car of the team, as one controller. `scenario` must outlive it; copies
/// share their trackers.
sim::Controller tracking_controller(const world::Scenario& scenario, const mpc::Options& options);

}  // namespace seine::drive
