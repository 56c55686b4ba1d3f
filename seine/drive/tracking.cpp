#include "seine/drive/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "seine/mpc/tracker.hpp"

namespace seine::drive {
namespace {

constexpr double kFarthest = 3.0;  // s

// A car's tracker and room for its reference.
struct Driver {
  Driver(const vehicle::Model& car, const mpc::Options& options)
      : model(car), tracker(car, options), reference(static_cast<std::size_t>(options.horizon) + 1) {}

  vehicle::Model model;
  mpc::Tracker tracker;
  std::vector<mpc::Sample> reference;
};

mpc::State state_of(const geom::Pose2& pose, double speed) {
  return {pose.x, pose.y, pose.heading, speed};
}

// On the clock that the team follows, which may be slowing down.
void sample(const sim::Reference& reference, double wheelbase, double step,
            std::vector<mpc::Sample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double ahead = step * static_cast<double>(k);
    const traj::State now = reference.at(ahead), middle = reference.at(ahead + 0.5 * step);
    samples[k] = {state_of(now.pose, now.speed),
                  {middle.acceleration, std::atan(wheelbase * middle.curvature)}};
  }
}

sim::Control control(Driver& driver, const sim::CarState& now, const sim::Reference& reference, bool fails) {
  const mpc::Options& options = driver.tracker.options();
  sample(reference, driver.model.wheelbase, options.step, driver.reference);
  mpc::State state = state_of(now.pose, now.speed);
  // To the tracker a state that is no number is a failure like any other.
  if (fails) state.x = std::numeric_limits<double>::quiet_NaN();
  driver.tracker.observe({now.acceleration, now.steering});
  const mpc::Command command = driver.tracker.step(state, driver.reference);
  return {{command.input.acceleration, command.input.steering}, command.source != mpc::Source::tracking};
}

// As far ahead as the wheel takes from lock to lock: a slow wheel that is late stays late for as long.
mpc::Options scaled(mpc::Options options, const vehicle::Model& model) {
  const double lock_to_lock = 2.0 * model.limits.steering / model.limits.steering_rate;
  const double usual = options.horizon * options.step;
  const double ahead = std::clamp(lock_to_lock, usual, std::max(usual, kFarthest));
  options.horizon = static_cast<int>(std::lround(ahead / options.step));
  return options;
}

}  // namespace

mpc::Options tracking_options(const sim::Noise& noise) {
  mpc::Options options;
  options.period = sim::kControlPeriod;
  options.lag = std::max(noise.acceleration_lag, noise.steering_lag);
  return options;
}

sim::Controller tracking_controller(const world::Scenario& scenario, const mpc::Options& options) {
  const auto drivers = std::make_shared<std::vector<Driver>>();
  for (const world::Robot& robot : scenario.robots)
    drivers->emplace_back(scenario.model_of(robot), scaled(options, scenario.model_of(robot)));
  return [drivers](std::size_t robot, const sim::CarState& now, const sim::Reference& reference, bool fails) {
    return control((*drivers)[robot], now, reference, fails);
  };
}

}  // namespace seine::drive
