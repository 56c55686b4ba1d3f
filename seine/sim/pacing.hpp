#pragma once

#include <span>

#include "seine/sim/car.hpp"
#include "seine/sim/plan_clock.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::sim {

/// How far a car has fallen behind its way, m: along the reference's direction of travel; negative ahead of
/// it.
double lag_behind(const geom::Pose2& car, const traj::State& reference);

/// The rate that the team's clock should run at so that no car is left behind: 1 while all keep up. A plan
/// may ask for a car's top speed; a car whose wheels slip then cannot catch up unless the team waits for it.
double pace_of(const traj::TeamTrajectory& plan, const PlanClock& clock, std::span<const Car> cars);

}  // namespace seine::sim
