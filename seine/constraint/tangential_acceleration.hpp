#pragma once

namespace seine::constraint {

/// |a_t| / a_max − 1 ≤ 0. @param d_tangential ∂/∂a_t
inline double tangential_acceleration(double a_t, double a_max, double& d_tangential) {
  const double per = 1.0 / a_max;  // one division for all samples of a loop
  d_tangential = a_t < 0.0 ? -per : per;
  return a_t * d_tangential - 1.0;
}

}  // namespace seine::constraint
