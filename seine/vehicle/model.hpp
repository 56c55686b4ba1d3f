#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "seine/geom/convex.hpp"

namespace seine::vehicle {

/// What a car can do. SI units; infinity means no limit.
struct Limits {
  double speed = 2.5;          ///< m/s, forwards
  double reverse_speed = 2.5;  ///< m/s, backwards, ≥ 0
  double acceleration = 3.0;   ///< m/s², |a_t|, both speeding up and braking
  double lateral_acceleration = std::numeric_limits<double>::infinity();  ///< m/s², |a_n| = v² |κ|
  double steering = 0.70;                                                 ///< rad, |φ|
  double steering_rate = std::numeric_limits<double>::infinity();         ///< rad/s, |φ̇|
};

/// A car: kinematic bicycle ẋ = v cos θ, ẏ = v sin θ, θ̇ = v tan φ / L, v̇ = a, with a convex footprint. The
/// body frame's origin is the middle of the rear axle, x forward.
struct Model {
  std::string name = "default";
  std::vector<geom::Vec2> footprint;  ///< convex, counter-clockwise, body frame, metres
  double wheelbase = 0.40;            ///< L, m
  Limits limits;

  /// κ_max = tan φ_max / L, 1/m.
  double max_curvature() const { return std::tan(limits.steering) / wheelbase; }
  /// Extent of the footprint along x: the unit of length that parameters scale with.
  double length() const;
  double width() const;
  /// Largest distance of a footprint point from the rear axle.
  double reach() const;
};

/// The rectangle from −rear_overhang to length − rear_overhang, half a width to either side.
std::vector<geom::Vec2> rectangle_footprint(double length, double width, double rear_overhang);

/// The car of the CL-MAPF benchmark [Wen22]: 3 × 2 m, minimum turning radius 3 m, 1 m/s, 1 m/s².
Model clmapf_car();
/// The car of the TPCAP 2022 parking cases [Li22].
Model tpcap_car();

}  // namespace seine::vehicle
