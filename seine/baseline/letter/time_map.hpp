#pragma once

#include <cmath>

namespace seine::baseline::letter {

/// The supplement's diffeomorphism from all numbers to positive durations [Pei24, T(τ)]:
///   T = τ²/2 + τ + 1 (τ > 0),   2 / (τ² − 2τ + 2) (τ ≤ 0).
inline double duration_of(double tau) {
  return tau > 0.0 ? (0.5 * tau + 1.0) * tau + 1.0 : 2.0 / ((tau - 2.0) * tau + 2.0);
}

/// dT/dτ.
inline double duration_slope(double tau) {
  if (tau > 0.0) return tau + 1.0;
  const double below = (tau - 2.0) * tau + 2.0;
  return 4.0 * (1.0 - tau) / (below * below);
}

/// τ for T > 0.
inline double tau_of(double duration) {
  return duration > 1.0 ? std::sqrt(2.0 * duration - 1.0) - 1.0 : 1.0 - std::sqrt(2.0 / duration - 1.0);
}

}  // namespace seine::baseline::letter
