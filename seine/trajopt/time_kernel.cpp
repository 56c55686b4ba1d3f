// The limits in time at the samples of one piece of progress.
#include <algorithm>
#include <cmath>

#include "seine/base/simd.hpp"
#include "seine/constraint/lateral_acceleration.hpp"
#include "seine/constraint/progress.hpp"
#include "seine/constraint/speed.hpp"
#include "seine/constraint/tangential_acceleration.hpp"
#include "seine/math/hinge.hpp"
#include "seine/math/quad.hpp"
#include "seine/trajopt/kernel_basis.hpp"
#include "seine/trajopt/kernels.hpp"
#include "seine/vehicle/flatness.hpp"

namespace seine::trajopt {
namespace {

// Moving against the gear is never a little wrong: it weighs more than a limit exceeded by the same share.
constexpr double kProgress = 5.0;

constexpr Basis<kTimeLanes> kTime;

// What one piece of progress hands from loop to loop. Its samples lie on one or two pieces of the curve,
// rarely more, so the curve is read and its gradient written piece by piece under a mask: far cheaper than to
// gather and scatter ten numbers for every sample.
struct TimeLanes {
  alignas(64) double u1[kTimeLanes], u2[kTimeLanes];    // u̇, ü
  alignas(64) double piece[kTimeLanes], w[kTimeLanes];  // of the curve
  int first, last;                                      // pieces the samples lie on
  // The curve's coefficients under each sample; afterwards ∂J/∂ of them.
  alignas(64) double x[6][kTimeLanes], y[6][kTimeLanes];
  alignas(64) double gu[kTimeLanes], gu1[kTimeLanes], gu2[kTimeLanes];
};

[[gnu::always_inline]] inline void place(const double* cu, int stride, int pieces, double rate,
                                         TimeLanes& lanes) {
  const double end = pieces - 1.0;
  double c[6];
  for (int k = 0; k < 6; ++k) c[k] = cu[k * stride];
  double first = end, last = 0.0;
#pragma omp simd reduction(min : first) reduction(max : last)
  for (int j = 0; j < kTimeLanes; ++j) {
    double u = 0, u1 = 0, u2 = 0;
    for (int k = 0; k < 6; ++k) {
      u += c[k] * kTime.value[0][k][j];
      u1 += c[k] * kTime.value[1][k][j];
      u2 += c[k] * kTime.value[2][k][j];
    }
    // Written so that a NaN from a wild trial step lands on piece 0 rather than anywhere.
    double inside = u > 0.0 ? u : 0.0;
    inside = inside < end ? inside : end;
    const double piece = static_cast<int>(inside);
    lanes.u1[j] = u1 * rate, lanes.u2[j] = u2 * (rate * rate);
    lanes.piece[j] = piece, lanes.w[j] = u - piece;
    first = piece < first ? piece : first;
    last = piece > last ? piece : last;
  }
  lanes.first = static_cast<int>(first), lanes.last = static_cast<int>(last);
}

[[gnu::always_inline]] inline void read_curve(const CurveView& curve, TimeLanes& lanes) {
  for (int k = 1; k < 6; ++k) {
    const double *x = curve.cx + k * curve.stride, *y = curve.cy + k * curve.stride;
    double of_x = x[lanes.first], of_y = y[lanes.first];
#pragma omp simd
    for (int j = 0; j < kTimeLanes; ++j) lanes.x[k][j] = of_x, lanes.y[k][j] = of_y;
    for (int piece = lanes.first + 1; piece <= lanes.last; ++piece) {
      of_x = x[piece], of_y = y[piece];
#pragma omp simd
      for (int j = 0; j < kTimeLanes; ++j) {
        const double old_x = lanes.x[k][j], old_y = lanes.y[k][j];
        lanes.x[k][j] = lanes.piece[j] == piece ? of_x : old_x;
        lanes.y[k][j] = lanes.piece[j] == piece ? of_y : old_y;
      }
    }
  }
}

// The weighted hinges of one sample, and their gradient by v, a_t, a_n.
struct LimitGradient {
  double speed, tangential, lateral;
};
[[gnu::always_inline]] inline double limits(const vehicle::Motion& q, const TimeWeights& weights,
                                            const math::Knee& knee, LimitGradient& g) {
  double d, slope;
  double cost = math::hinge(constraint::speed(q.speed, weights.speed, d), knee, slope);
  g.speed = slope * d;
  cost += kProgress *
          math::hinge(constraint::progress(q.speed - weights.least_speed, weights.speed, d), knee, slope);
  g.speed += kProgress * slope * d;
  cost +=
      math::hinge(constraint::tangential_acceleration(q.tangential, weights.acceleration, d), knee, slope);
  g.tangential = weights.weight * slope * d;
  cost += math::hinge(constraint::lateral_acceleration(q.lateral, weights.lateral, d), knee, slope);
  g.lateral = weights.weight * slope * d;
  g.speed *= weights.weight;
  return weights.weight * cost;
}

[[gnu::always_inline]] inline double limits_of_lanes(const TimeWeights& weights, double rate,
                                                     TimeLanes& lanes, double& g_duration) {
  const math::Knee knee(weights.knee);
  double cost = 0.0, g_h = 0.0;
#pragma omp simd reduction(+ : cost, g_h)
  for (int j = 0; j < kTimeLanes; ++j) {
    const double w = lanes.w[j], u1 = lanes.u1[j], u2 = lanes.u2[j];
    const double x2 = lanes.x[2][j], x3 = lanes.x[3][j], x4 = lanes.x[4][j], x5 = lanes.x[5][j];
    const double y2 = lanes.y[2][j], y3 = lanes.y[3][j], y4 = lanes.y[4][j], y5 = lanes.y[5][j];
    vehicle::FlatMotion f;
    f.d1x = lanes.x[1][j] + w * (2 * x2 + w * (3 * x3 + w * (4 * x4 + w * 5 * x5)));
    f.d1y = lanes.y[1][j] + w * (2 * y2 + w * (3 * y3 + w * (4 * y4 + w * 5 * y5)));
    f.d2x = 2 * x2 + w * (6 * x3 + w * (12 * x4 + w * 20 * x5));
    f.d2y = 2 * y2 + w * (6 * y3 + w * (12 * y4 + w * 20 * y5));
    const double d3x = 6 * x3 + w * (24 * x4 + w * 60 * x5), d3y = 6 * y3 + w * (24 * y4 + w * 60 * y5);
    f.u1 = u1, f.u2 = u2;
    const vehicle::Motion q = vehicle::motion_of(f);
    LimitGradient by;
    cost += limits(q, weights, knee, by);
    const vehicle::FlatMotion g = vehicle::motion_adjoint(f, q, by.speed, by.tangential, by.lateral);
    // ∂p'/∂c_k = k w^(k−1), ∂p''/∂c_k = k (k−1) w^(k−2).
    double first = 1.0, second = 0.0;
    for (int k = 1; k < 6; ++k) {
      lanes.x[k][j] = k * (first * g.d1x + second * g.d2x);
      lanes.y[k][j] = k * (first * g.d1y + second * g.d2y);
      second = k * first;
      first *= w;
    }
    lanes.gu[j] = g.d1x * f.d2x + g.d1y * f.d2y + g.d2x * d3x + g.d2y * d3y;
    lanes.gu1[j] = g.u1 * rate, lanes.gu2[j] = g.u2 * (rate * rate);
    g_h -= (g.u1 * u1 + 2.0 * g.u2 * u2) * rate;
  }
  g_duration += g_h;
  return cost;
}

[[gnu::always_inline]] inline void write_curve(const TimeLanes& lanes, const CurveView& curve) {
  for (int piece = lanes.first; piece <= lanes.last; ++piece) {
    alignas(64) double x[6][kTimeLanes], y[6][kTimeLanes];
    for (int k = 1; k < 6; ++k) {
#pragma omp simd
      for (int j = 0; j < kTimeLanes; ++j) {
        x[k][j] = lanes.piece[j] == piece ? lanes.x[k][j] : 0.0;
        y[k][j] = lanes.piece[j] == piece ? lanes.y[k][j] : 0.0;
      }
    }
    math::Quad of_x, of_y, of_last;
    math::sums(x[1], x[2], x[3], x[4], of_x);
    math::sums(y[1], y[2], y[3], y[4], of_y);
    math::sums(x[5], y[5], x[5], y[5], of_last);
    double *gx = curve.gcx + piece, *gy = curve.gcy + piece;
    for (int k = 1; k < 5; ++k) gx[k * curve.stride] += of_x[k - 1], gy[k * curve.stride] += of_y[k - 1];
    gx[5 * curve.stride] += of_last[0], gy[5 * curve.stride] += of_last[1];
  }
}

[[gnu::always_inline]] inline void write_progress(const TimeLanes& lanes, double* gcu, int stride) {
  alignas(64) double g[6][kTimeLanes];
  for (int k = 0; k < 6; ++k) {
#pragma omp simd
    for (int j = 0; j < kTimeLanes; ++j)
      g[k][j] = kTime.value[0][k][j] * lanes.gu[j] + kTime.value[1][k][j] * lanes.gu1[j] +
                kTime.value[2][k][j] * lanes.gu2[j];
  }
  math::Quad low, high;
  math::sums(g[0], g[1], g[2], g[3], low);
  math::sums(g[4], g[5], g[4], g[5], high);
  for (int k = 0; k < 4; ++k) gcu[k * stride] += low[k];
  gcu[4 * stride] += high[0], gcu[5 * stride] += high[1];
}

}  // namespace

SEINE_WIDEST
double time_piece(const double* cu, double* gcu, int stride, const CurveView& curve,
                  const TimeWeights& weights, double& g_duration) {
  const double rate = 1.0 / weights.piece_duration;
  TimeLanes lanes;
  place(cu, stride, curve.pieces, rate, lanes);
  read_curve(curve, lanes);
  const double cost = limits_of_lanes(weights, rate, lanes, g_duration);
  if (cost == 0.0) return 0.0;
  write_curve(lanes, curve);
  write_progress(lanes, gcu, stride);
  return cost;
}

}  // namespace seine::trajopt
