#pragma once

namespace seine::constraint {

/// (|p'|²/l² − 1)²: the curve runs at its nominal length l per unit of u, so that u measures arc length. A
/// regulariser, not a limit.
struct RegularityGradient {
  double d1x, d1y, length;  ///< ∂/∂(p', l)
};

inline double regularity(double d1x, double d1y, double length, RegularityGradient& gradient) {
  const double inverse2 = 1.0 / (length * length), ratio = (d1x * d1x + d1y * d1y) * inverse2,
               r = ratio - 1.0;
  const double f = 4.0 * r * inverse2;
  gradient = {f * d1x, f * d1y, -4.0 * r * ratio / length};
  return r * r;
}

}  // namespace seine::constraint
