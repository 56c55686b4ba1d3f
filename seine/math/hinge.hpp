#pragma once

namespace seine::math {

/// The penalty of a violation x: zero for x ≤ 0, C² everywhere, linear with slope 1 beyond the knee a0 (the
/// supplement's L1 [Pei24]):
///   −x⁴/(2 a0³) + x³/a0²   (0 < x ≤ a0),      x − a0/2   (x > a0).
/// Written without branches so that loops over it vectorise. @param slope receives dL/dx.
inline double hinge(double x, double knee, double& slope) {
  const double positive = x > 0.0 ? x : 0.0;
  const double inside = positive < knee ? positive : knee;
  const double r = inside / knee;
  slope = r * r * (3.0 - 2.0 * r);
  return inside * r * r * (1.0 - 0.5 * r) + (positive - inside);
}

}  // namespace seine::math
