#pragma once

namespace seine::constraint {

/// v / v_max − 1 ≤ 0 for the unsigned speed v in the segment's gear (v_max is the forward or the reverse
/// limit). @param d_speed ∂/∂v
inline double speed(double v, double v_max, double& d_speed) {
  d_speed = 1.0 / v_max;
  return v * d_speed - 1.0;
}

}  // namespace seine::constraint
