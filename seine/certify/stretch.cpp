#include "seine/certify/stretch.hpp"

#include <cmath>

namespace seine::certify {
namespace {

using geom::Vec2;
using traj::Quintic;

/// Derivatives 0 … 5 of a quintic by its parameter.
std::array<double, 6> derivatives(const Quintic& c, double w) {
  return {c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5])))),
          c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5]))),
          2.0 * c[2] + w * (6.0 * c[3] + w * (12.0 * c[4] + w * 20.0 * c[5])),
          6.0 * c[3] + w * (24.0 * c[4] + w * 60.0 * c[5]),
          24.0 * c[4] + w * 120.0 * c[5],
          120.0 * c[5]};
}

/// Upper bounds of |f^(k)|, k = 1 … 5, within `r` of the point where the magnitudes are `at`: Taylor's
/// formula, which ends at the fifth derivative. Entry 0 bounds |f − f(middle)|.
std::array<double, 6> magnitudes_within(const std::array<double, 6>& at, double r) {
  std::array<double, 6> bound{};
  bound[5] = at[5];
  for (std::size_t k = 5; k-- > 0;) {
    double sum = 0.0, power = 1.0;
    for (std::size_t j = 1; k + j <= 5; ++j) {
      power *= r / static_cast<double>(j);
      sum += at[k + j] * power;
    }
    bound[k] = (k == 0 ? 0.0 : at[k]) + sum;
  }
  return bound;
}

}  // namespace

Frame Stretch::frame(double w) const {
  const Quintic &c = *progress, &a = *x, &b = *y;
  const double s = c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5])))) - knot;
  const Vec2 p{a[0] + s * (a[1] + s * (a[2] + s * (a[3] + s * (a[4] + s * a[5])))),
               b[0] + s * (b[1] + s * (b[2] + s * (b[3] + s * (b[4] + s * b[5]))))};
  const Vec2 d{a[1] + s * (2.0 * a[2] + s * (3.0 * a[3] + s * (4.0 * a[4] + s * 5.0 * a[5]))),
               b[1] + s * (2.0 * b[2] + s * (3.0 * b[3] + s * (4.0 * b[4] + s * 5.0 * b[5])))};
  return {p, (gear / geom::norm(d)) * d};
}

Sample Stretch::sample(double w, double wheelbase) const {
  const auto q = derivatives(*progress, w);
  const double u = q[0] - knot, rate = q[1] / h, rate2 = q[2] / (h * h);  // u̇, ü
  const auto dx = derivatives(*x, u), dy = derivatives(*y, u);
  const Vec2 p1{dx[1], dy[1]}, p2{dx[2], dy[2]}, p3{dx[3], dy[3]};
  const double m = geom::norm(p1), m3 = m * m * m;
  const double along = geom::dot(p1, p2), across = geom::cross(p1, p2);
  const double kappa = across / m3;
  const double kappa_u = (geom::cross(p1, p3) - 3.0 * across * along / (m * m)) / m3;
  const double z = wheelbase * kappa;  // tan φ

  Sample sample{w, u, {{dx[0], dy[0]}, (gear / m) * p1}, {}};
  sample.value[pace] = m * rate;
  sample.value[tangential] = m * rate2 + along / m * rate * rate;
  sample.value[lateral] = across / m * rate * rate;
  sample.value[curvature] = kappa;
  sample.value[steering_rate] = wheelbase * kappa_u * rate / (1.0 + z * z);
  return sample;
}

Bends Stretch::bends(double w0, double w1, double wheelbase, double reach) const {
  const double middle = 0.5 * (w0 + w1), inverse = 1.0 / h;
  auto q = derivatives(*progress, middle);
  const double u = q[0] - knot;
  double scale = 1.0;
  for (double& derivative : q) derivative = std::abs(derivative) * scale, scale *= inverse;
  const auto b = magnitudes_within(q, 0.5 * (w1 - w0) * h);  // b[k] ≥ |d^k u / dt^k|

  const auto dx = derivatives(*x, u), dy = derivatives(*y, u);
  std::array<double, 6> length{};
  for (std::size_t k = 1; k < 6; ++k) length[k] = geom::norm(geom::Vec2{dx[k], dy[k]});
  const auto a = magnitudes_within(length, b[0]);  // a[k] ≥ |p^(k)|

  Bends bends;
  bends.half_range = b[0];
  bends.middle_length = length[1];
  bends.least_length = 2.0 * length[1] - a[1];  // |p'| leaves its middle value by at most a[1] − |p'(middle)|
  if (!(bends.least_length > 0.0)) return bends;
  const double m = 1.0 / bends.least_length;

  // Ratios of derivatives to the length of p': m is |p'|, e1 ≥ |m'|/m, e2 ≥ |m''|/m, e3 ≥ |m'''|/m.
  const double r2 = a[2] * m, r3 = a[3] * m, r4 = a[4] * m, r5 = a[5] * m;
  const double e1 = r2, e2 = r2 * r2 + r3, e3 = 3.0 * r2 * r3 + r4 + 3.0 * r2 * e2;
  const double b1 = b[1], b2 = b[2], b3 = b[3], b4 = b[4];

  bends.value[pace] = a[1] * (e2 * b1 * b1 * b1 + 3.0 * e1 * b1 * b2 + b3);
  bends.value[tangential] =
      a[1] * (b1 * b1 * (e3 * b1 * b1 + 6.0 * e2 * b2) + e1 * (3.0 * b2 * b2 + 4.0 * b1 * b3) + b4);

  // q = X/m with X = p' × p''; q0 … q2 bound its derivatives by u.
  const double q0 = a[2], q1 = a[3] + q0 * e1, q2 = a[2] * r3 + a[4] + 2.0 * q1 * e1 + q0 * e2;
  bends.value[lateral] = b1 * b1 * (q2 * b1 * b1 + 5.0 * q1 * b2) + 2.0 * q0 * (b2 * b2 + b1 * b3);

  // κ = X/m³; k0 … k3 bound its derivatives by u (from differentiating κ m³ = X).
  const double f2 = 2.0 * e1 * e1 + e2, f3 = 2.0 * e1 * e1 * e1 + 6.0 * e1 * e2 + e3;
  const double k0 = r2 * m, k1 = r3 * m + 3.0 * k0 * e1;
  const double k2 = (r2 * r3 + r4) * m + 6.0 * k1 * e1 + 3.0 * k0 * f2;
  const double k3 = (2.0 * r2 * r4 + r5) * m + 9.0 * k2 * e1 + 9.0 * k1 * f2 + 3.0 * k0 * f3;
  bends.value[curvature] = k2;

  // φ = atan z, z = Lκ; |d/dz 1/(1 + z²)| ≤ 0.65 and |d²/dz² 1/(1 + z²)| ≤ 2.
  const double z1 = wheelbase * k1, z2 = wheelbase * k2, z3 = wheelbase * k3;
  const double phi1 = z1, phi2 = z2 + 0.65 * z1 * z1, phi3 = z3 + 1.95 * z1 * z2 + 2.0 * z1 * z1 * z1;
  bends.value[steering_rate] = phi3 * b1 * b1 * b1 + 3.0 * phi2 * b1 * b2 + phi1 * b3;

  // θ_u = X/m²; a footprint point accelerates by |p̈| + reach (|θ̈| + θ̇²).
  const double turn = r2 * b1;
  const double turn2 = (r3 + 2.0 * r2 * r2) * b1 * b1 + r2 * b2;
  bends.vertex = a[2] * b1 * b1 + a[1] * b2 + reach * (turn2 + turn * turn);
  return bends;
}

}  // namespace seine::certify
