#pragma once

#include "seine/sim/car_plant.hpp"
#include "seine/sim/plan_clock.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::sim {

/// What a car of a team with a net does that no longer answers, and how the others go with it. It brakes with
/// its wheel held, on an arc that leaves its way. The others copy how it leaves: each is where the plan has
/// it, shifted as the silent car is from where the plan has that. So the net keeps the shape it has in the
/// plan, whatever the clock shows.
class Escort {
 public:
  /// @param silent as it is believed to be now  @param way the one it was to follow
  Escort(const vehicle::Model& model, const CarState& silent, const traj::RobotTrajectory& way);

  bool stands() const;
  /// The same, looked at `duration` later.
  Escort later(double duration) const;
  /// What another car should do `ahead` seconds from now. @param clock of the team, now
  traj::State state_on(const traj::RobotTrajectory& other, const PlanClock& clock, double ahead) const;

 private:
  CarState silent_at(double time) const;
  geom::Pose2 place_on(const traj::RobotTrajectory& other, const PlanClock& clock, double ahead) const;

  CarState silent_;
  const traj::RobotTrajectory* way_;
  double curvature_, braking_;  // 1/m, m/s²
  double since_ = 0.0;          // s
};

}  // namespace seine::sim
