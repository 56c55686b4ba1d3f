#include "seine/sim/car_plant.hpp"

#include <algorithm>
#include <cmath>

#include "seine/vehicle/arc.hpp"

namespace seine::sim {
namespace {

constexpr double kSlipMemory = 0.3;  // s

// A first-order lag for `duration`; none when the time constant is zero.
double towards(double value, double wanted, double lag, double duration) {
  return lag > 0.0 ? wanted + (value - wanted) * std::exp(-duration / lag) : wanted;
}

}  // namespace

CarState drive_on(const vehicle::Model& model, const Noise& noise, const CarState& from,
                  const Command& wanted, double duration, double stretch, double twist, double push) {
  const vehicle::Limits& limits = model.limits;
  CarState to = from;
  const double asked = std::clamp(wanted.acceleration, -limits.acceleration, limits.acceleration);
  to.acceleration = towards(from.acceleration, asked, noise.acceleration_lag, duration);
  const double angle = std::clamp(wanted.steering, -limits.steering, limits.steering);
  const double turned = towards(from.steering, angle, noise.steering_lag, duration) - from.steering;
  const double most = limits.steering_rate * duration;
  to.steering = from.steering + std::clamp(turned, -most, most);
  to.speed = from.speed + duration * (0.5 * (from.acceleration + to.acceleration) + push);
  // With an ideal motor the new acceleration acts from the first moment on.
  if (noise.acceleration_lag <= 0.0) to.speed = from.speed + duration * (to.acceleration + push);
  const double distance = 0.5 * (from.speed + to.speed) * duration;
  const double curvature = std::tan(0.5 * (from.steering + to.steering)) / model.wheelbase;
  to.pose = vehicle::drive(from.pose, curvature * twist, distance * stretch);
  return to;
}

CarPlant::CarPlant(const vehicle::Model& model, const Noise& noise, const CarState& start, std::uint64_t seed)
    : model_(model),
      noise_(noise),
      rng_(seed),
      state_(start),
      acting_{start.acceleration, start.steering},
      slip_along_(noise.slip, kSlipMemory, rng_),
      slip_turning_(noise.slip, kSlipMemory, rng_) {}

// Brakes to a stop and stays there.
Command CarPlant::emergency(double duration) const {
  const double hardest = kWatchdogBraking * model_.limits.acceleration;
  return {std::clamp(-state_.speed / duration, -hardest, hardest), state_.steering};
}

void CarPlant::advance(double duration, geom::Vec2 pull) {
  time_ += duration;
  while (!waiting_.empty() && waiting_.front().due <= time_) {
    acting_ = waiting_.front().command;
    waiting_.pop_front();
  }
  slip_along_.advance(duration, rng_);
  slip_turning_.advance(duration, rng_);
  const double pulled = geom::dot(pull, state_.pose.direction()) / kCarMass;
  taken_up_ = towards(taken_up_.value_or(pulled), pulled, kTakeUp, duration);
  const double push = pulled - *taken_up_;
  state_ = drive_on(model_, noise_, state_, broken_ ? emergency(duration) : acting_, duration,
                    1.0 + slip_along_.value(), 1.0 + slip_turning_.value(), push);
}

}  // namespace seine::sim
