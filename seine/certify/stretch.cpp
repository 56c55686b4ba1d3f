#include "seine/certify/stretch.hpp"

#include <cmath>

namespace seine::certify {
namespace {

using geom::Vec2;
using traj::Quintic;

/// Derivatives 0 … 5 of a quintic by its parameter.
std::array<double, 6> derivatives(const Quintic& c, double w) {
  const auto d = traj::derivatives_at(c, w);
  return {d[0], d[1], d[2], d[3], 24.0 * c[4] + w * 120.0 * c[5], 120.0 * c[5]};
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
  const auto [p, tangent] = drive.place(w);
  return {p, (drive.gear / geom::norm(tangent)) * tangent};
}

Sample Stretch::sample(double w, double wheelbase) const {
  const traj::Flow flow = drive.flow(w);
  const traj::Rates rates = drive.rates(flow);
  const double z = wheelbase * rates.curvature;  // tan φ
  Sample sample{w, flow.u, {flow.p, (drive.gear / rates.length) * flow.p1}, rates.length, {}};
  sample.value[pace] = drive.gear * rates.speed;
  sample.value[tangential] = drive.gear * rates.acceleration;
  sample.value[lateral] = drive.gear * rates.lateral_acceleration;
  sample.value[curvature] = drive.gear * rates.curvature;
  sample.value[steering_rate] = drive.gear * wheelbase * rates.curvature_rate / (1.0 + z * z);
  return sample;
}

Bends Stretch::bends(double w0, double w1, double wheelbase, double reach) const {
  const double middle = 0.5 * (w0 + w1), inverse = 1.0 / drive.h;
  auto q = derivatives(*drive.progress, middle);
  const double u = q[0] - drive.knot;
  double scale = 1.0;
  for (double& derivative : q) derivative = std::abs(derivative) * scale, scale *= inverse;
  const auto b = magnitudes_within(q, 0.5 * (w1 - w0) * drive.h);  // b[k] ≥ |d^k u / dt^k|

  const auto dx = derivatives(*drive.x, u), dy = derivatives(*drive.y, u);
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
  bends.curvature_by_time = k2 * b1 * b1 + k1 * b2;

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
