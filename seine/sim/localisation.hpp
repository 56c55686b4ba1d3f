#pragma once

#include <cstdint>

#include "seine/base/rng.hpp"
#include "seine/sim/car_plant.hpp"
#include "seine/sim/drifting_error.hpp"

namespace seine::sim {

/// Where a car believes to be: fixes of its pose some times a second, each with an error that drifts, and
/// between them (or when they fail) what its wheels tell.
class Localisation {
 public:
  static constexpr double kOdometryPeriod = 0.01;  ///< s
  static constexpr int kFixEvery = 2;              ///< of these

  Localisation(const vehicle::Model& model, const Noise& noise, const CarState& start, std::uint64_t seed);

  /// To be called every kOdometryPeriod with what is true. Without a fix it goes by its wheels alone.
  void look(const CarState& truth, bool fix_available);
  const CarState& belief() const { return belief_; }
  double since_fix() const { return since_fix_; }  ///< s

 private:
  void roll(const CarState& truth);
  void fix(const CarState& truth);

  const vehicle::Model& model_;
  Noise noise_;
  Rng rng_;
  CarState belief_;
  DriftingError x_, y_, heading_, speed_scale_, steering_offset_;
  int ticks_ = 0;
  double since_fix_ = 0.0;
};

}  // namespace seine::sim
