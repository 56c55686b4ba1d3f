#include "seine/trajopt/kernels.hpp"

#include "seine/base/simd.hpp"
#include "seine/constraint/curvature.hpp"
#include "seine/constraint/regularity.hpp"
#include "seine/math/hinge.hpp"
#include "seine/trajopt/kernel_basis.hpp"

namespace seine::trajopt {
namespace {

constexpr Basis<kCurveLanes> kCurve;

}  // namespace

SEINE_WIDEST
double curve_piece(const double* cx, const double* cy, int stride, const CurveWeights& weights,
                   CurveLanes& lanes, double& g_length) {
  double x[6], y[6];
  for (int k = 0; k < 6; ++k) x[k] = cx[k * stride], y[k] = cy[k * stride];
  const math::Knee knee(weights.knee);
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
    cost += weights.curvature * math::hinge(excess, knee, slope);
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

}  // namespace seine::trajopt
