#pragma once

#include <span>

#include "seine/mpc/model.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::mpc {

/// What the car should do at one instant.
struct Sample {
  State state;
  Input input;
};

/// Fills `samples` with the trajectory at times from, from + step, …
void sample(const traj::RobotTrajectory& trajectory, double wheelbase, double from, double step,
            std::span<Sample> samples);

}  // namespace seine::mpc
