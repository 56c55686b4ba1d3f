#include "seine/mpc/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "seine/base/error.hpp"

namespace seine::mpc {
namespace {

bool finite(const State& s) {
  return std::isfinite(s.x + s.y + s.heading + s.speed);
}
bool finite(const Sample& s) {
  return finite(s.state) && std::isfinite(s.input.acceleration + s.input.steering);
}

Options checked(const Options& options) {
  const std::vector<std::string> complaints = options.validate();
  if (!complaints.empty()) throw InputError("tracker: " + complaints.front());
  return options;
}

Input clamped(const Input& input, const Input& most) {
  return {std::clamp(input.acceleration, -most.acceleration, most.acceleration),
          std::clamp(input.steering, -most.steering, most.steering)};
}

}  // namespace

Tracker::Tracker(const vehicle::Model& model, const Options& options, SolverFactory make_solver)
    : model_(model),
      options_(checked(options)),
      qp_(model, options_),
      actuators_(options.dead_time, options.lag, options.period),
      x_(static_cast<std::size_t>(TrackingQp::kVariables * options.horizon)),
      y_(static_cast<std::size_t>(TrackingQp::kRows * options.horizon)),
      plan_(static_cast<std::size_t>(options.horizon)),
      reference_(static_cast<std::size_t>(options.horizon) + 1) {
  // A car that drives gives the scaling something to look at.
  std::fill(reference_.begin(), reference_.end(), Sample{{0.0, 0.0, 0.0, model.limits.speed}, {}});
  qp_.set(reference_[0].state, {}, reference_);
  solver_ =
      make_solver ? make_solver(qp_.problem(), options_.qp) : make_qp_solver(qp_.problem(), options_.qp);
}

void Tracker::observe(const Input& acting) {
  actuators_.observe(clamped(acting, qp_.most()));
}

void Tracker::reset(const Input& acting) {
  actuators_.reset(acting);
  planned_ = false;
  failures_ = 0;
}

Command Tracker::step(const State& now, const traj::RobotTrajectory& trajectory, double t) {
  sample(trajectory, model_.wheelbase, t + options_.dead_time, options_.step, reference_);
  return step(now, reference_);
}

Command Tracker::step(const State& now, std::span<const Sample> reference) {
  Command command;
  const State state = finite(now) ? now : believed_;
  const Actuators::Outlook from = actuators_.outlook(state, model_.wheelbase);
  const bool fit = finite(now) && reference.size() == plan_.size() + 1 &&
                   std::all_of(reference.begin(), reference.end(), [](const Sample& s) { return finite(s); });
  Input wanted;
  if (fit && solve(from, reference, command)) {
    failures_ = 0;
    command.source = Source::tracking;
    wanted = qp_.input(x_, 0);
    keep_plan();
  } else {
    wanted = fall_back(from, command.source);
  }
  command.input = clamped(actuators_.command_for(wanted, from.acting), qp_.most());
  believed_ = actuators_.send(command.input, state, model_.wheelbase);
  return command;
}

bool Tracker::solve(const Actuators::Outlook& from, std::span<const Sample> reference, Command& command) {
  qp_.set(from.state, from.acting, reference);
  solver_->update(qp_.problem());
  if (planned_) solver_->warm_start(x_, y_);
  command.qp = solver_->solve();
  const auto finite = [](std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  if (command.qp.status != optim::QpStatus::solved || !finite(solver_->x()) || !finite(solver_->y()))
    return false;
  std::copy(solver_->x().begin(), solver_->x().end(), x_.begin());
  std::copy(solver_->y().begin(), solver_->y().end(), y_.begin());
  return true;
}

// Inputs, solution and multipliers, as they will be when the next command is due.
void Tracker::keep_plan() {
  const bool moves_on = options_.period > 0.5 * options_.step;
  for (int k = 0; k < options_.horizon; ++k)
    plan_[static_cast<std::size_t>(k)] =
        qp_.input(x_, std::min(k + (moves_on ? 1 : 0), options_.horizon - 1));
  if (moves_on) {
    TrackingQp::shift(x_, TrackingQp::kVariables);
    TrackingQp::shift(y_, TrackingQp::kRows);
  }
  planned_ = true;
}

// The last good plan for a few steps, then a stop: steering as it is, braking no harder than can be let go of
// again, at the rate allowed, by the time the car stands.
Input Tracker::fall_back(const Actuators::Outlook& from, Source& source) {
  ++failures_;
  if (planned_ && failures_ <= options_.reuse) {
    source = Source::reused;
    const double passed = std::floor((failures_ - 1) * options_.period / options_.step);
    return limited(plan_[static_cast<std::size_t>(std::min(passed, options_.horizon - 1.0))], from.acting);
  }
  planned_ = false;
  source = Source::stopping;
  const double rate = qp_.most_change().acceleration / options_.step, speed = std::abs(from.state.speed);
  const double brake = std::min(
      {speed / options_.period, std::sqrt(2.0 * rate * speed), options_.stopping * qp_.most().acceleration});
  return limited({std::copysign(brake, -from.state.speed), from.acting.steering}, from.acting);
}

Input Tracker::limited(const Input& wish, const Input& acting) const {
  const Input change = qp_.most_change();
  const double share = options_.period / options_.step;
  const auto near = [share](double value, double to, double step) {
    return std::clamp(value, to - share * step, to + share * step);
  };
  return clamped({near(wish.acceleration, acting.acceleration, change.acceleration),
                  near(wish.steering, acting.steering, change.steering)},
                 qp_.most());
}

}  // namespace seine::mpc
