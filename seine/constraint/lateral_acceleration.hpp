#pragma once

namespace seine::constraint {

/// |a_n| / a_lat,max − 1 ≤ 0; an infinite limit is never reached. @param d_lateral ∂/∂a_n
inline double lateral_acceleration(double a_n, double a_lat_max, double& d_lateral) {
  const double per = 1.0 / a_lat_max;  // one division for all samples of a loop
  d_lateral = a_n < 0.0 ? -per : per;
  return a_n * d_lateral - 1.0;
}

}  // namespace seine::constraint
