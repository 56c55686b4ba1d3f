#pragma once

namespace seine::math {

/// A knee and its inverse: in a vector loop the division would cost as much as all the rest.
struct Knee {
  double at, inverse;
  explicit Knee(double knee) : at(knee), inverse(1.0 / knee) {}
};

/// The penalty of a violation x: zero for x ≤ 0, C² everywhere, linear with slope 1 beyond the knee a0 (the
/// supplement's L1 [Pei24]):
///   −x⁴/(2 a0³) + x³/a0²   (0 < x ≤ a0),      x − a0/2   (x > a0).
/// Written without branches so that loops over it vectorise. @param slope receives dL/dx.
inline double hinge(double x, const Knee& knee, double& slope) {
  const double positive = x > 0.0 ? x : 0.0;
  const double inside = positive < knee.at ? positive : knee.at;
  const double r = inside * knee.inverse;
  slope = r * r * (3.0 - 2.0 * r);
  return inside * r * r * (1.0 - 0.5 * r) + (positive - inside);
}
inline double hinge(double x, double knee, double& slope) {
  return hinge(x, Knee(knee), slope);
}

}  // namespace seine::math
