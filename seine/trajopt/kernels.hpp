#pragma once

#include <array>

namespace seine::trajopt {

/// Samples on one piece of the curve (w = 0, 1/16, … 15/16) and of the progress (w = 0, 1/8, … 7/8). The end
/// of a piece is the begin of the next; the end of a segment is a rest, where everything is known from the
/// boundary data.
constexpr int kCurveLanes = 16;
constexpr int kTimeLanes = 8;

using CurveArray = std::array<double, kCurveLanes>;

/// The curve at the samples of one piece, and ∂J/∂ of each.
struct CurveLanes {
  alignas(64) CurveArray px, py, d1x, d1y, d2x, d2y;
  alignas(64) CurveArray gpx, gpy, g1x, g1y, g2x, g2y;
};

struct CurveWeights {
  double kappa_max;  ///< tightened
  double length;     ///< l
  double knee;
  double curvature;   ///< weight of one sample's hinge
  double regularity;  ///< weight of one sample's square
};

/// Evaluates p, p', p'' on one piece (coefficients c[k · stride]), and the curvature and regularity terms
/// with their gradients (g… of `lanes` are overwritten). Returns the cost; adds ∂J/∂l to `g_length`.
double curve_piece(const double* cx, const double* cy, int stride, const CurveWeights& weights,
                   CurveLanes& lanes, double& g_length);

/// Adds the adjoint of the samples to ∂J/∂coefficients (same layout).
void curve_piece_adjoint(const CurveLanes& lanes, double* gcx, double* gcy, int stride);

struct TimeWeights {
  double piece_duration;                ///< h
  double speed, acceleration, lateral;  ///< limits, tightened; `speed` is of the segment's gear
  double least_speed;                   ///< of a moving car; 0: just not against its gear
  double knee;
  double weight;  ///< of one sample's hinge
};

/// A segment's curve as the time kernel sees it: `pieces` pieces of coefficients and of gradients.
struct CurveView {
  const double *cx, *cy;
  double *gcx, *gcy;
  int stride, pieces;
};

/// The limits on speed, acceleration and lateral acceleration, and u̇ ≥ 0, at the samples of one piece of
/// progress (coefficients cu[k · stride]). Adds to all gradients; returns the cost; adds ∂J/∂h (through u̇ and
/// ü only) to `g_duration`.
double time_piece(const double* cu, double* gcu, int stride, const CurveView& curve,
                  const TimeWeights& weights, double& g_duration);

}  // namespace seine::trajopt
