#include "seine/sim/car.hpp"

#include <algorithm>

namespace seine::sim {
namespace {

constexpr double kForesightStep = 0.01;  // s
constexpr double kParkAfter = 0.3;       // s after its way has ended a car only holds its brake

}  // namespace

Car::Car(const vehicle::Model& model, const Noise& noise, const CarState& start, std::uint64_t seed)
    : model_(model),
      noise_(noise),
      plant_(model, noise, start, seed),
      localisation_(model, noise, start, ~seed),
      last_{start.acceleration, start.steering},
      sent_{{-1e300, last_}} {}

// What was sent before still acts for the dead time: the model of the car says where that leads.
CarState Car::expected(double time) const {
  CarState state = belief();
  double passed = 0.0;
  auto acting = sent_.begin();
  while (passed < noise_.dead_time - 1e-9) {
    const double step = std::min(kForesightStep, noise_.dead_time - passed);
    while (std::next(acting) != sent_.end() &&
           std::next(acting)->time + noise_.dead_time <= time + passed + 1e-9)
      ++acting;
    state = drive_on(model_, noise_, state, acting->command, step);
    passed += step;
  }
  return state;
}

// Stands still whatever its localisation says: chasing that would keep it moving for ever. What still acts
// has its say before the command does; twice the lag is patience enough not to rock to and fro.
Command Car::parked(double time) const {
  const double hardest = model_.limits.acceleration, lag = noise_.acceleration_lag;
  const CarState then = expected(time);
  const double rolling = then.speed + lag * then.acceleration;
  return {std::clamp(-rolling / (kControlPeriod + 2.0 * lag), -hardest, hardest), belief().steering};
}

void Car::control(std::size_t index, double time, const Reference& now, const Controller& controller,
                  bool fails) {
  Reference reference{now.way, now.clock.ahead(noise_.dead_time), now.escort};
  if (reference.escort) reference.escort = reference.escort->later(noise_.dead_time);
  const bool leads = now.escort && !now.escort->stands();
  const bool arrived = !leads && (now.clock.stands() || now.clock.time() > now.way.arrival() + kParkAfter);
  const Control control =
      arrived ? Control{parked(time)} : controller(index, expected(time), reference, fails);
  failures_ = control.failed ? failures_ + 1 : 0;
  last_ = control.command;
  plant_.command(last_);
  sent_.push_back({time, last_});
  while (sent_.size() > 2 && sent_[1].time + noise_.dead_time < time) sent_.pop_front();
}

}  // namespace seine::sim
