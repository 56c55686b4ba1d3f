#pragma once

#include "seine/traj/trajectory.hpp"

namespace seine::sim {

/// The clock that a team follows its plan by. It runs evenly; to stop, it slows down: then every car still
/// goes along its own way, and the team passes only through formations that the plan's certificate has seen.
class PlanClock {
 public:
  explicit PlanClock(double time = 0.0) : time_(time) {}

  double time() const { return time_; }  ///< s, on the plan's clock
  double rate() const { return rate_; }  ///< 1: as planned, 0: standing
  bool stands() const { return rate_ == 0.0; }

  /// Changes of the rate from now on, 1/s, until it is 0 or 1.
  void accelerate(double change) { accelerate(change, change < 0.0 ? 0.0 : 1.0); }
  /// The same, until the rate is `wanted`.
  void accelerate(double change, double wanted) { change_ = change, wanted_ = wanted; }
  void advance(double duration) { *this = ahead(duration); }
  /// The clock as it will be.
  PlanClock ahead(double duration) const;
  /// What `way` asks for now: slower than planned when the clock is.
  traj::State state_on(const traj::RobotTrajectory& way) const;

 private:
  double time_ = 0.0, rate_ = 1.0, change_ = 0.0, wanted_ = 1.0;
};

}  // namespace seine::sim
