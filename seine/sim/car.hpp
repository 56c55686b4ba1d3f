#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "seine/sim/car_plant.hpp"
#include "seine/sim/localisation.hpp"
#include "seine/sim/simulation.hpp"

namespace seine::sim {

/// A car of the team: the machine, what it believes, and the program that drives it.
class Car {
 public:
  Car(const vehicle::Model& model, const Noise& noise, const CarState& start, std::uint64_t seed);

  /// Asks the controller for where the car will be when the command takes effect. @param fails on purpose
  void control(std::size_t index, double time, const Reference& now, const Controller& controller,
               bool fails);
  void sense(bool fix_available) { localisation_.look(plant_.state(), fix_available); }
  void advance(double duration, geom::Vec2 pull) { plant_.advance(duration, pull); }
  void break_down() { plant_.break_down(); }

  const CarState& truth() const { return plant_.state(); }
  const CarState& belief() const { return localisation_.belief(); }
  const Command& command() const { return last_; }
  double since_fix() const { return localisation_.since_fix(); }
  int failures() const { return failures_; }  ///< of the controller, in a row

 private:
  struct Sent {
    double time;
    Command command;
  };
  CarState expected(double time) const;
  Command parked(double time) const;

  const vehicle::Model& model_;
  Noise noise_;
  CarPlant plant_;
  Localisation localisation_;
  Command last_;
  std::deque<Sent> sent_;  // not older than the dead time, and one before
  int failures_ = 0;
};

}  // namespace seine::sim
