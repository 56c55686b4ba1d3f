#pragma once

#include <cmath>

namespace seine::constraint {

/// What the steering rate depends on: p', p'', p''' and u̇.
struct SteeringSample {
  double d1x, d1y, d2x, d2y, d3x, d3y, u1;
};

/// |φ̇| / φ̇_max − 1 ≤ 0 with φ = atan(L κ):  φ̇ = L κ' u̇ / (1 + L² κ²),  κ = c/m³, κ' = c'/m³ − 3 c b/m⁵,  c =
/// p'×p'', c' = p'×p''', b = p'·p''.
/// @param gradient ∂/∂ of every field of the sample
inline double steering_rate(const SteeringSample& s, double wheelbase, double rate_max,
                            SteeringSample& gradient) {
  const double m2 = s.d1x * s.d1x + s.d1y * s.d1y, i2 = 1.0 / m2, i3 = i2 * std::sqrt(i2), i5 = i3 * i2;
  const double c = s.d1x * s.d2y - s.d1y * s.d2x, c1 = s.d1x * s.d3y - s.d1y * s.d3x;
  const double b = s.d1x * s.d2x + s.d1y * s.d2y;
  const double kappa = c * i3, slope = c1 * i3 - 3.0 * c * b * i5;
  const double q = 1.0 / (1.0 + wheelbase * wheelbase * kappa * kappa);
  const double rate = wheelbase * slope * s.u1 * q;
  const double sign = (rate < 0.0 ? -1.0 : 1.0) / rate_max;
  const double g_slope = sign * wheelbase * s.u1 * q;
  const double g_kappa = -sign * rate * 2.0 * wheelbase * wheelbase * kappa * q;
  const double g_c = g_kappa * i3 - 3.0 * g_slope * b * i5, g_c1 = g_slope * i3,
               g_b = -3.0 * g_slope * c * i5;
  const double g_m2 = -1.5 * g_kappa * c * i5 + g_slope * (-1.5 * c1 * i5 + 7.5 * c * b * i5 * i2);
  gradient.d1x = g_c * s.d2y + g_c1 * s.d3y + g_b * s.d2x + 2.0 * g_m2 * s.d1x;
  gradient.d1y = -g_c * s.d2x - g_c1 * s.d3x + g_b * s.d2y + 2.0 * g_m2 * s.d1y;
  gradient.d2x = -g_c * s.d1y + g_b * s.d1x;
  gradient.d2y = g_c * s.d1x + g_b * s.d1y;
  gradient.d3x = -g_c1 * s.d1y;
  gradient.d3y = g_c1 * s.d1x;
  gradient.u1 = sign * wheelbase * slope * q;
  return sign * rate - 1.0;
}

}  // namespace seine::constraint
