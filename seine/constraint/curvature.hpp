#pragma once

#include <cmath>

namespace seine::constraint {

/// |κ| / κ_max − 1 ≤ 0 with κ = p'×p'' / |p'|³ of the curve itself. The ratio stays well behaved because |p'|
/// does not vanish in the two-layer form; the division-free form invites the optimiser to hide at v → 0.
struct CurvatureGradient {
  double d1x, d1y, d2x, d2y;  ///< ∂/∂(p', p'')
};

inline double curvature(double d1x, double d1y, double d2x, double d2y, double kappa_max,
                        CurvatureGradient& gradient) {
  const double m2 = d1x * d1x + d1y * d1y, inverse = 1.0 / std::sqrt(m2), inverse2 = inverse * inverse;
  const double inverse3 = inverse * inverse2;
  const double kappa = (d1x * d2y - d1y * d2x) * inverse3;
  const double per = 1.0 / kappa_max;  // one division for all samples of a loop
  const double sign = kappa < 0.0 ? -per : per;
  const double along = 3.0 * kappa * inverse2;
  gradient = {sign * (d2y * inverse3 - along * d1x), sign * (-d2x * inverse3 - along * d1y),
              -sign * d1y * inverse3, sign * d1x * inverse3};
  return sign * kappa - 1.0;
}

}  // namespace seine::constraint
