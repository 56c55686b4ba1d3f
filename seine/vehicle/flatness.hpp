#pragma once

#include <cmath>

namespace seine::vehicle {

/// The flat map of a curve p(u) traversed by u(t), gear left out (docs/trajectory.md): with m = |p'|, D =
/// p'·p''/m, X = p'×p''/m,
///   speed v = m u̇,   a_t = m ü + D u̇²,   a_n = X u̇²,   κ = X/m².
/// Driving backwards, the signed quantities are η v, η a_t, and the front wheel's curvature η κ.
struct FlatMotion {
  double d1x, d1y, d2x, d2y;  ///< p', p''
  double u1, u2;              ///< u̇, ü
};

struct Motion {
  double m, D, X;     ///< |p'|, p'·p''/m, p'×p''/m
  double speed;       ///< v
  double tangential;  ///< a_t
  double lateral;     ///< a_n
};

inline Motion motion_of(const FlatMotion& f) {
  const double m = std::sqrt(f.d1x * f.d1x + f.d1y * f.d1y), inverse = 1.0 / m;
  const double D = (f.d1x * f.d2x + f.d1y * f.d2y) * inverse, X = (f.d1x * f.d2y - f.d1y * f.d2x) * inverse;
  const double u11 = f.u1 * f.u1;
  return {m, D, X, m * f.u1, m * f.u2 + D * u11, X * u11};
}

/// ∂J/∂(p', p'', u̇, ü) from ∂J/∂(v, a_t, a_n).
inline FlatMotion motion_adjoint(const FlatMotion& f, const Motion& q, double g_speed, double g_tangential,
                                 double g_lateral) {
  const double inverse = 1.0 / q.m, u11 = f.u1 * f.u1;
  const double g_D = g_tangential * u11 * inverse, g_X = g_lateral * u11 * inverse;
  const double g_m = (g_speed * f.u1 + g_tangential * f.u2) * inverse - (g_D * q.D + g_X * q.X) * inverse;
  return {g_m * f.d1x + g_D * f.d2x + g_X * f.d2y,
          g_m * f.d1y + g_D * f.d2y - g_X * f.d2x,
          g_D * f.d1x - g_X * f.d1y,
          g_D * f.d1y + g_X * f.d1x,
          g_speed * q.m + 2.0 * f.u1 * (g_tangential * q.D + g_lateral * q.X),
          g_tangential * q.m};
}

}  // namespace seine::vehicle
