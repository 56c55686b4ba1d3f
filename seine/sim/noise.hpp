#pragma once

#include <string_view>

namespace seine::sim {

/// How far the world is from what a plan takes for granted. All zero: cars, sensors and throws are ideal.
struct Noise {
  // Cars: the command takes effect after the dead time, then through first-order lags.
  double dead_time = 0.0;         ///< s
  double acceleration_lag = 0.0;  ///< s, time constant
  double steering_lag = 0.0;      ///< s, time constant
  double slip = 0.0;              ///< of speed and of yaw rate, standard deviation
  // Where cars believe to be: errors that change within about a second, as those of real localisation do.
  double position = 0.0;  ///< m, standard deviation along each axis
  double heading = 0.0;   ///< rad
  double odometry = 0.0;  ///< of the measured speed, and rad of the measured steering
  // How objects in the air are seen.
  double sight_period = 0.01;  ///< s
  double sight_delay = 0.0;    ///< s
  double sight = 0.0;          ///< m, standard deviation along each axis
  double dropouts = 0.0;       ///< part of the sights that never come
  double outliers = 0.0;       ///< part of the sights that are wrong …
  double outlier_size = 0.5;   ///< … by so much along each axis, m
  // How objects are thrown, beside the covariance that the scenario states.
  double throw_position = 0.0;  ///< m, standard deviation along each axis
  double throw_velocity = 0.0;  ///< m/s
};

/// "none", "low" (a laboratory with motion capture) or "high" (cars that find their way with their own
/// sensors). Throws InputError for other names.
Noise noise_named(std::string_view name);

}  // namespace seine::sim
