#pragma once

#include <array>

#include "seine/geom/vec2.hpp"
#include "seine/traj/drive.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::certify {

/// Where a body frame stands: its origin and its x axis (unit).
struct Frame {
  geom::Vec2 position;
  geom::Vec2 forward{1.0, 0.0};
};

/// The scalar quantities that have limits, as indices. `pace` is η v = |p'| u̇; the others carry the sign
/// their formula gives.
enum Quantity { pace, tangential, lateral, curvature, steering_rate, kQuantities };

/// An instant of a stretch.
struct Sample {
  double w = 0.0;  ///< local parameter of the progress piece, in [0, 1]
  double u = 0.0;  ///< local parameter of the curve piece
  Frame frame;
  double length = 0.0;                      ///< |p'|, m
  std::array<double, kQuantities> value{};  ///< m/s, m/s², m/s², 1/m, rad/s
};

/// Upper bounds over an interval of w, all from the polynomials (docs/certificate.md derives them).
struct Bends {
  double least_length = 0.0;                ///< lower bound of |p'|, m
  double middle_length = 0.0;               ///< |p'| in the middle, m
  double half_range = 0.0;                  ///< u stays within this of its value in the middle
  double vertex = 0.0;                      ///< of the acceleration of any footprint point, m/s²
  std::array<double, kQuantities> value{};  ///< of |second derivative|: by t in s, for the curvature by u
  double curvature_by_time = 0.0;           ///< of the curvature's second derivative by t in s
};

/// One quintic of the curve driven by one quintic of the progress: everything on it is analytic.
struct Stretch {
  traj::Drive drive;   ///< the formula of the plan
  double begin = 0.0;  ///< s, common clock, where the progress piece begins

  double clock(double w) const { return begin + drive.h * w; }
  double local(double t) const { return (t - begin) / drive.h; }
  Frame frame(double w) const;
  Sample sample(double w, double wheelbase) const;
  /// @param reach largest distance of a footprint point from the rear axle, m
  Bends bends(double w0, double w1, double wheelbase, double reach) const;
};

}  // namespace seine::certify
