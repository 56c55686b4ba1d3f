#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "seine/base/rng.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/sim/drifting_error.hpp"
#include "seine/sim/noise.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::sim {

/// What a car is told.
struct Command {
  double acceleration = 0.0;  ///< m/s², along the car's x axis
  double steering = 0.0;      ///< rad
};

/// How a car stands and moves. Also what a controller is given: then as far as the car knows.
struct CarState {
  geom::Pose2 pose;
  double speed = 0.0;         ///< m/s, signed
  double steering = 0.0;      ///< rad, where the wheel stands
  double acceleration = 0.0;  ///< m/s²
};

inline constexpr double kCarMass = 15.0;  ///< kg: only what the net's pull does to a car depends on it …
inline constexpr double kTakeUp = 0.15;   ///< s, … until the motor's own speed loop has taken it up

/// Of the limit of acceleration, by which a car brakes whose computer has failed: gently enough that the
/// others, which learn of it later, can keep up and the net stays whole.
inline constexpr double kWatchdogBraking = 0.7;

/// One step of the bicycle with its lags towards `wanted`: exact arc for the mean speed and curvature.
/// `stretch` and `twist` are factors on the distance and the turn (1 without slip), `push` is an acceleration
/// from outside (m/s²) along the car.
CarState drive_on(const vehicle::Model& model, const Noise& noise, const CarState& from,
                  const Command& wanted, double duration, double stretch = 1.0, double twist = 1.0,
                  double push = 0.0);

/// A car as it really moves: kinematic bicycle behind dead time, lags, a limited steering rate, wheel slip
/// and the pull of the net.
class CarPlant {
 public:
  CarPlant(const vehicle::Model& model, const Noise& noise, const CarState& start, std::uint64_t seed);

  const CarState& state() const { return state_; }
  /// Takes effect after the dead time.
  void command(const Command& command) { waiting_.push_back({time_ + noise_.dead_time, command}); }
  /// The car's computer fails: its watchdog brakes with the wheel held, whatever it is told.
  void break_down() { broken_ = true; }
  /// @param pull N, of the net on its attachment, horizontal
  void advance(double duration, geom::Vec2 pull);

 private:
  struct Waiting {
    double due;
    Command command;
  };
  Command emergency(double duration) const;

  const vehicle::Model& model_;
  Noise noise_;
  Rng rng_;
  CarState state_;
  Command acting_;
  std::deque<Waiting> waiting_;
  DriftingError slip_along_, slip_turning_;
  double time_ = 0.0;
  std::optional<double> taken_up_;  // m/s², of the net's pull
  bool broken_ = false;
};

}  // namespace seine::sim
