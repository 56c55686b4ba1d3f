#include "seine/mpc/actuators.hpp"

#include <algorithm>
#include <cmath>

namespace seine::mpc {
namespace {

// Of the gap between input and command, what is left after dt, and what there is on average until then.
struct Gap {
  double left, average;
};
Gap gap_after(double dt, double lag) {
  if (lag <= 0.0 || dt <= 0.0) return {lag <= 0.0 ? 0.0 : 1.0, lag <= 0.0 ? 0.0 : 1.0};
  const double left = std::exp(-dt / lag);
  return {left, lag / dt * (1.0 - left)};
}

Input between(const Input& a, const Input& b, double share_of_a) {
  return {share_of_a * a.acceleration + (1.0 - share_of_a) * b.acceleration,
          share_of_a * a.steering + (1.0 - share_of_a) * b.steering};
}

}  // namespace

Actuators::Actuators(double dead_time, double lag, double period)
    : dead_time_(dead_time),
      lag_(lag),
      period_(period),
      underway_(static_cast<std::size_t>(std::ceil(dead_time / period - 1e-9))) {}

void Actuators::reset(const Input& acting) {
  acting_ = acting;
  std::fill(underway_.begin(), underway_.end(), acting);
}

Actuators::Outlook Actuators::follow(Outlook from, const Input& command, double wheelbase, double dt) const {
  const Gap gap = gap_after(dt, lag_);
  return {advance(from.state, between(from.acting, command, gap.average), wheelbase, dt),
          between(from.acting, command, gap.left)};
}

Actuators::Outlook Actuators::outlook(const State& now, double wheelbase) const {
  Outlook outlook{now, acting_};
  double left = dead_time_;
  // The first has been acting for a while when the dead time is no multiple of the period.
  for (std::size_t i = 0; i < underway_.size(); ++i) {
    const double rest = period_ * static_cast<double>(underway_.size() - i - 1);
    outlook = follow(outlook, underway_[i], wheelbase, left - rest);
    left = rest;
  }
  return outlook;
}

double Actuators::kept_on_average(double lag, double duration) {
  return gap_after(duration, lag).average;
}

Input Actuators::command_for(const Input& wanted, const Input& acting) const {
  const double average = kept_on_average(lag_, period_), gain = 1.0 / (1.0 - average);
  return {gain * (wanted.acceleration - average * acting.acceleration),
          gain * (wanted.steering - average * acting.steering)};
}

State Actuators::send(const Input& command, const State& now, double wheelbase) {
  Outlook outlook{now, acting_};
  if (underway_.empty()) {
    outlook = follow(outlook, command, wheelbase, period_);
  } else {
    const double first = dead_time_ - period_ * static_cast<double>(underway_.size() - 1);
    outlook = follow(outlook, underway_[0], wheelbase, first);
    outlook = follow(outlook, underway_.size() > 1 ? underway_[1] : command, wheelbase, period_ - first);
    std::copy(underway_.begin() + 1, underway_.end(), underway_.begin());
    underway_.back() = command;
  }
  acting_ = outlook.acting;
  return outlook.state;
}

}  // namespace seine::mpc
