#pragma once

#include <cstddef>
#include <optional>

#include "seine/sim/car_plant.hpp"
#include "seine/sim/plan_clock.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::sim {

/// How fast the clock may change its rate, 1/s, with every car keeping its limit of acceleration on its own
/// way. `except` cannot be told anything.
struct RateChange {
  double least, most;
};
RateChange possible_change(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                           const PlanClock& clock, std::optional<std::size_t> except);

/// Where on the plan's clock a car is by its place: the nearest time around `guess` (s).
double progress_of(const traj::RobotTrajectory& way, geom::Vec2 place, double guess);

/// The change of the clock's rate, 1/s, that stops the team: as soon as it can, or together with a car that
/// goes its own way and no longer answers.
double stopping_change(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                       const PlanClock& clock, std::optional<std::size_t> silent,
                       const CarState& silent_state);

}  // namespace seine::sim
