#include "seine/sim/escort.hpp"

#include <algorithm>
#include <cmath>

#include "seine/vehicle/arc.hpp"

namespace seine::sim {
namespace {

constexpr double kStanding = 0.03;  // m/s
constexpr double kMoment = 0.02;    // s, for velocities and accelerations
constexpr double kSlow = 0.2;       // m/s: below it the wheel is where the plan has it

}  // namespace

Escort::Escort(const vehicle::Model& model, const CarState& silent, const traj::RobotTrajectory& way)
    : silent_(silent),
      way_(&way),
      curvature_(std::tan(silent.steering) / model.wheelbase),
      braking_(kWatchdogBraking * model.limits.acceleration) {}

bool Escort::stands() const {
  return std::abs(silent_at(0.0).speed) < kStanding;
}

Escort Escort::later(double duration) const {
  Escort later = *this;
  later.since_ += duration;
  return later;
}

CarState Escort::silent_at(double time) const {
  const double t = std::max(0.0, since_ + time), speed = std::abs(silent_.speed);
  const double braked = std::min(t, speed / braking_), left = speed - braking_ * braked;
  const double length = std::copysign(0.5 * (speed + left) * braked, silent_.speed);
  CarState then = silent_;
  then.pose = vehicle::drive(silent_.pose, curvature_, length);
  then.speed = std::copysign(left, silent_.speed);
  return then;
}

geom::Pose2 Escort::place_on(const traj::RobotTrajectory& other, const PlanClock& clock, double ahead) const {
  const double then = clock.ahead(std::max(0.0, ahead)).time();
  const geom::Pose2 silent = silent_at(ahead).pose, planned = way_->at(then).pose;
  geom::Pose2 place = other.at(then).pose;
  place.x += silent.x - planned.x;
  place.y += silent.y - planned.y;
  place.heading = geom::wrap_angle(place.heading + silent.heading - planned.heading);
  return place;
}

traj::State Escort::state_on(const traj::RobotTrajectory& other, const PlanClock& clock, double ahead) const {
  traj::State state = clock.ahead(ahead).state_on(other);
  const double middle = std::max(ahead, kMoment);
  const geom::Pose2 before = place_on(other, clock, middle - kMoment), now = place_on(other, clock, middle),
                    after = place_on(other, clock, middle + kMoment);
  const geom::Vec2 direction = now.direction();
  const geom::Vec2 there = after.position() - before.position();
  const geom::Vec2 bend = after.position() - 2.0 * now.position() + before.position();
  state.pose = place_on(other, clock, ahead);
  state.speed = geom::dot(there, direction) / (2.0 * kMoment);
  state.acceleration = geom::dot(bend, direction) / (kMoment * kMoment);
  if (std::abs(state.speed) > kSlow)
    state.curvature = geom::wrap_angle(after.heading - before.heading) / (2.0 * kMoment * state.speed);
  return state;
}

}  // namespace seine::sim
