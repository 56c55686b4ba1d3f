#include "seine/trajopt/kernels.hpp"

#include <cmath>
#include <cstring>

#include "seine/constraint/curvature.hpp"
#include "seine/constraint/lateral_acceleration.hpp"
#include "seine/constraint/progress.hpp"
#include "seine/constraint/regularity.hpp"
#include "seine/constraint/speed.hpp"
#include "seine/constraint/tangential_acceleration.hpp"
#include "seine/math/hinge.hpp"
#include "seine/vehicle/flatness.hpp"

// One binary serves every x86-64: the loader picks the widest instruction set the machine has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(SEINE_SANITIZED)
#define SEINE_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SEINE_WIDEST
#endif

namespace seine::trajopt {
namespace {

// basis.value[d][k][j] = d-th derivative of w^k at w = j / Lanes.
template <int Lanes>
struct Basis {
  alignas(64) double value[3][6][Lanes];
  constexpr Basis() : value{} {
    for (int j = 0; j < Lanes; ++j) {
      const double w = static_cast<double>(j) / Lanes;
      double power = 1.0;
      for (int k = 0; k < 6; ++k) {
        value[0][k][j] = power;
        if (k + 1 < 6) value[1][k + 1][j] = (k + 1) * power;
        if (k + 2 < 6) value[2][k + 2][j] = (k + 1) * (k + 2) * power;
        power *= w;
      }
    }
  }
};
// Moving against the gear is never a little wrong: it weighs more than a limit exceeded by the same share.
constexpr double kProgress = 5.0;

constexpr Basis<kCurveLanes> kCurve;
constexpr Basis<kTimeLanes> kTime;

}  // namespace

SEINE_WIDEST
double curve_piece(const double* cx, const double* cy, int stride, const CurveWeights& weights,
                   CurveLanes& lanes, double& g_length) {
  double x[6], y[6];
  for (int k = 0; k < 6; ++k) x[k] = cx[k * stride], y[k] = cy[k * stride];
  double cost = 0.0, g_l = 0.0;
#pragma omp simd reduction(+ : cost, g_l)
  for (int j = 0; j < kCurveLanes; ++j) {
    double px = 0, py = 0, d1x = 0, d1y = 0, d2x = 0, d2y = 0;
    for (int k = 0; k < 6; ++k) {
      px += x[k] * kCurve.value[0][k][j], py += y[k] * kCurve.value[0][k][j];
      d1x += x[k] * kCurve.value[1][k][j], d1y += y[k] * kCurve.value[1][k][j];
      d2x += x[k] * kCurve.value[2][k][j], d2y += y[k] * kCurve.value[2][k][j];
    }
    constraint::CurvatureGradient c;
    double slope;
    const double excess = constraint::curvature(d1x, d1y, d2x, d2y, weights.kappa_max, c);
    cost += weights.curvature * math::hinge(excess, weights.knee, slope);
    slope *= weights.curvature;
    constraint::RegularityGradient r;
    cost += weights.regularity * constraint::regularity(d1x, d1y, weights.length, r);
    g_l += weights.regularity * r.length;
    lanes.px[static_cast<std::size_t>(j)] = px, lanes.py[static_cast<std::size_t>(j)] = py;
    lanes.d1x[static_cast<std::size_t>(j)] = d1x, lanes.d1y[static_cast<std::size_t>(j)] = d1y;
    lanes.d2x[static_cast<std::size_t>(j)] = d2x, lanes.d2y[static_cast<std::size_t>(j)] = d2y;
    lanes.gpx[static_cast<std::size_t>(j)] = 0.0, lanes.gpy[static_cast<std::size_t>(j)] = 0.0;
    lanes.g1x[static_cast<std::size_t>(j)] = slope * c.d1x + weights.regularity * r.d1x;
    lanes.g1y[static_cast<std::size_t>(j)] = slope * c.d1y + weights.regularity * r.d1y;
    lanes.g2x[static_cast<std::size_t>(j)] = slope * c.d2x;
    lanes.g2y[static_cast<std::size_t>(j)] = slope * c.d2y;
  }
  g_length += g_l;
  return cost;
}

SEINE_WIDEST
void curve_piece_adjoint(const CurveLanes& lanes, double* gcx, double* gcy, int stride) {
  for (int k = 0; k < 6; ++k) {
    double gx = 0.0, gy = 0.0;
#pragma omp simd reduction(+ : gx, gy)
    for (int j = 0; j < kCurveLanes; ++j) {
      const auto i = static_cast<std::size_t>(j);
      gx += kCurve.value[0][k][j] * lanes.gpx[i] + kCurve.value[1][k][j] * lanes.g1x[i] +
            kCurve.value[2][k][j] * lanes.g2x[i];
      gy += kCurve.value[0][k][j] * lanes.gpy[i] + kCurve.value[1][k][j] * lanes.g1y[i] +
            kCurve.value[2][k][j] * lanes.g2y[i];
    }
    gcx[k * stride] += gx;
    gcy[k * stride] += gy;
  }
}

namespace {

// What one piece of progress hands from its vector loop to its scatter loop.
struct TimeLanes {
  alignas(64) double w[kTimeLanes], g1x[kTimeLanes], g1y[kTimeLanes], g2x[kTimeLanes], g2y[kTimeLanes],
      gu[kTimeLanes], gu1[kTimeLanes], gu2[kTimeLanes], cost[kTimeLanes];
  int piece[kTimeLanes];
};

[[gnu::always_inline]] inline void scatter(const TimeLanes& lanes, int j, const CurveView& curve) {
  double* gx = curve.gcx + lanes.piece[j];
  double* gy = curve.gcy + lanes.piece[j];
  const double w = lanes.w[j];
  // k w^(k−1) and k (k−1) w^(k−2)
  const double first_of[6] = {0, 1, 2 * w, 3 * w * w, 4 * w * w * w, 5 * w * w * w * w};
  const double second_of[6] = {0, 0, 2, 6 * w, 12 * w * w, 20 * w * w * w};
  for (int k = 1; k < 6; ++k) {
    gx[k * curve.stride] += first_of[k] * lanes.g1x[j] + second_of[k] * lanes.g2x[j];
    gy[k * curve.stride] += first_of[k] * lanes.g1y[j] + second_of[k] * lanes.g2y[j];
  }
}

}  // namespace

SEINE_WIDEST
double time_piece(const double* cu, double* gcu, int stride, const CurveView& curve,
                  const TimeWeights& weights, double& g_duration) {
  const double rate = 1.0 / weights.piece_duration, rate2 = rate * rate;
  const double last = curve.pieces - 1.0;
  double c[6];
  for (int k = 0; k < 6; ++k) c[k] = cu[k * stride];
  TimeLanes lanes;
  double cost = 0.0, g_h = 0.0;
#pragma omp simd reduction(+ : cost, g_h)
  for (int j = 0; j < kTimeLanes; ++j) {
    double u = 0, u1 = 0, u2 = 0;
    for (int k = 0; k < 6; ++k) {
      u += c[k] * kTime.value[0][k][j];
      u1 += c[k] * kTime.value[1][k][j];
      u2 += c[k] * kTime.value[2][k][j];
    }
    u1 *= rate, u2 *= rate2;
    // Written so that a NaN from a wild trial step lands on piece 0 rather than anywhere.
    double floor = u > 0.0 ? u : 0.0;
    floor = floor < last ? floor : last;
    const int piece = static_cast<int>(floor);
    const double w = u - piece;
    const double *x = curve.cx + piece, *y = curve.cy + piece;
    const int s = curve.stride;
    const double x2 = x[2 * s], x3 = x[3 * s], x4 = x[4 * s], x5 = x[5 * s];
    const double y2 = y[2 * s], y3 = y[3 * s], y4 = y[4 * s], y5 = y[5 * s];
    vehicle::FlatMotion f;
    f.d1x = x[s] + w * (2 * x2 + w * (3 * x3 + w * (4 * x4 + w * 5 * x5)));
    f.d1y = y[s] + w * (2 * y2 + w * (3 * y3 + w * (4 * y4 + w * 5 * y5)));
    f.d2x = 2 * x2 + w * (6 * x3 + w * (12 * x4 + w * 20 * x5));
    f.d2y = 2 * y2 + w * (6 * y3 + w * (12 * y4 + w * 20 * y5));
    const double d3x = 6 * x3 + w * (24 * x4 + w * 60 * x5), d3y = 6 * y3 + w * (24 * y4 + w * 60 * y5);
    f.u1 = u1, f.u2 = u2;
    const vehicle::Motion q = vehicle::motion_of(f);
    double d_speed, d_back, d_tangential, d_lateral, slope;
    double lane_cost = math::hinge(constraint::speed(q.speed, weights.speed, d_speed), weights.knee, slope);
    double g_speed = slope * d_speed;
    lane_cost +=
        kProgress * math::hinge(constraint::progress(q.speed, weights.speed, d_back), weights.knee, slope);
    g_speed += kProgress * slope * d_back;
    lane_cost +=
        math::hinge(constraint::tangential_acceleration(q.tangential, weights.acceleration, d_tangential),
                    weights.knee, slope);
    const double g_tangential = slope * d_tangential;
    lane_cost += math::hinge(constraint::lateral_acceleration(q.lateral, weights.lateral, d_lateral),
                             weights.knee, slope);
    const double g_lateral = slope * d_lateral;
    const vehicle::FlatMotion g = vehicle::motion_adjoint(
        f, q, weights.weight * g_speed, weights.weight * g_tangential, weights.weight * g_lateral);
    lanes.piece[j] = piece, lanes.w[j] = w, lanes.cost[j] = lane_cost;
    lanes.g1x[j] = g.d1x, lanes.g1y[j] = g.d1y, lanes.g2x[j] = g.d2x, lanes.g2y[j] = g.d2y;
    lanes.gu[j] = g.d1x * f.d2x + g.d1y * f.d2y + g.d2x * d3x + g.d2y * d3y;
    lanes.gu1[j] = g.u1 * rate, lanes.gu2[j] = g.u2 * rate2;
    g_h -= (g.u1 * u1 + 2.0 * g.u2 * u2) * rate;
    cost += weights.weight * lane_cost;
  }
  g_duration += g_h;
  if (cost == 0.0) return 0.0;
  for (int j = 0; j < kTimeLanes; ++j)
    if (lanes.cost[j] > 0.0) scatter(lanes, j, curve);
  for (int k = 0; k < 6; ++k) {
    double g = 0.0;
#pragma omp simd reduction(+ : g)
    for (int j = 0; j < kTimeLanes; ++j)
      g += kTime.value[0][k][j] * lanes.gu[j] + kTime.value[1][k][j] * lanes.gu1[j] +
           kTime.value[2][k][j] * lanes.gu2[j];
    gcu[k * stride] += g;
  }
  return cost;
}

}  // namespace seine::trajopt
