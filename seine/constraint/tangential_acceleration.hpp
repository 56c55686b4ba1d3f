#pragma once

namespace seine::constraint {

/// |a_t| / a_max − 1 ≤ 0. @param d_tangential ∂/∂a_t
inline double tangential_acceleration(double a_t, double a_max, double& d_tangential) {
  d_tangential = (a_t < 0.0 ? -1.0 : 1.0) / a_max;
  return a_t * d_tangential - 1.0;
}

}  // namespace seine::constraint
