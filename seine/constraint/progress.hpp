#pragma once

namespace seine::constraint {

/// −v / v_max ≤ 0: the car never moves against its gear. @param d_speed ∂/∂v
inline double progress(double v, double v_max, double& d_speed) {
  d_speed = -1.0 / v_max;
  return v * d_speed;
}

}  // namespace seine::constraint
