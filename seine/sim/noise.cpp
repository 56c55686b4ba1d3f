#include "seine/sim/noise.hpp"

#include <string>

#include "seine/base/error.hpp"

namespace seine::sim {

Noise noise_named(std::string_view name) {
  if (name == "none") return {};
  if (name == "low") {
    return {.dead_time = 0.02,
            .acceleration_lag = 0.05,
            .steering_lag = 0.05,
            .slip = 0.01,
            .position = 0.005,
            .heading = 0.003,
            .odometry = 0.005,
            .sight_delay = 0.01,
            .sight = 0.01,
            .dropouts = 0.02,
            .outliers = 0.01,
            .throw_position = 0.02,
            .throw_velocity = 0.03};
  }
  if (name == "high") {
    return {.dead_time = 0.05,
            .acceleration_lag = 0.10,
            .steering_lag = 0.10,
            .slip = 0.03,
            .position = 0.02,
            .heading = 0.01,
            .odometry = 0.01,
            .sight_period = 1.0 / 60.0,
            .sight_delay = 0.03,
            .sight = 0.03,
            .dropouts = 0.10,
            .outliers = 0.03,
            .throw_position = 0.05,
            .throw_velocity = 0.10};
  }
  throw InputError("there is no noise '" + std::string(name) + "', expected none, low or high");
}

}  // namespace seine::sim
