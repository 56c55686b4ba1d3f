#pragma once

namespace seine::constraint {

/// |a_n| / a_lat,max − 1 ≤ 0; an infinite limit is never reached. @param d_lateral ∂/∂a_n
inline double lateral_acceleration(double a_n, double a_lat_max, double& d_lateral) {
  d_lateral = (a_n < 0.0 ? -1.0 : 1.0) / a_lat_max;
  return a_n * d_lateral - 1.0;
}

}  // namespace seine::constraint
