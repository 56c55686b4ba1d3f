#include "seine/sim/plan_clock.hpp"

#include <algorithm>

namespace seine::sim {

PlanClock PlanClock::ahead(double duration) const {
  PlanClock later = *this;
  later.rate_ = std::clamp(rate_ + change_ * duration, 0.0, 1.0);
  // The rate changes evenly until it is 0 or 1, then stays.
  const double turning = change_ == 0.0 ? duration : (later.rate_ - rate_) / change_;
  later.time_ += 0.5 * (rate_ + later.rate_) * turning + later.rate_ * (duration - turning);
  const bool at_end = (later.rate_ == 0.0 && change_ < 0.0) || (later.rate_ == 1.0 && change_ > 0.0);
  if (at_end) later.change_ = 0.0;
  return later;
}

traj::State PlanClock::state_on(const traj::RobotTrajectory& way) const {
  traj::State state = way.at(time_);
  state.acceleration = rate_ * rate_ * state.acceleration + change_ * state.speed;
  state.speed *= rate_;
  state.lateral_acceleration *= rate_ * rate_;
  state.curvature_rate *= rate_;
  return state;
}

}  // namespace seine::sim
