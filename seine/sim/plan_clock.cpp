#include "seine/sim/plan_clock.hpp"

#include <algorithm>

namespace seine::sim {

PlanClock PlanClock::ahead(double duration) const {
  PlanClock later = *this;
  // The rate changes evenly until it is what is wanted, then stays.
  const double asked = rate_ + change_ * duration;
  later.rate_ =
      change_ < 0.0 ? std::max(asked, std::min(rate_, wanted_)) : std::min(asked, std::max(rate_, wanted_));
  const double turning = change_ == 0.0 ? duration : (later.rate_ - rate_) / change_;
  later.time_ += 0.5 * (rate_ + later.rate_) * turning + later.rate_ * (duration - turning);
  if (later.rate_ != asked || later.rate_ == wanted_) later.change_ = 0.0;
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
