#pragma once

#include <cmath>

#include "seine/base/rng.hpp"

namespace seine::sim {

/// A random error that changes slowly (Ornstein-Uhlenbeck): normal at every instant, forgotten after about
/// `memory`.
class DriftingError {
 public:
  /// @param sigma standard deviation; zero draws no random numbers
  /// @param memory s
  DriftingError(double sigma, double memory, Rng& rng)
      : sigma_(sigma), memory_(memory), value_(sigma > 0.0 ? sigma * rng.normal() : 0.0) {}

  double value() const { return value_; }
  void advance(double duration, Rng& rng) {
    if (sigma_ <= 0.0) return;
    const double kept = std::exp(-duration / memory_);
    value_ = kept * value_ + sigma_ * std::sqrt(1.0 - kept * kept) * rng.normal();
  }

 private:
  double sigma_, memory_, value_;
};

}  // namespace seine::sim
