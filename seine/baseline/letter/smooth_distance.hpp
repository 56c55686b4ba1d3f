#pragma once

#include <span>
#include <vector>

#include "seine/geom/vec2.hpp"

namespace seine::baseline::letter {

/// A convex footprint, prepared for separating gaps. Body frame, metres.
struct Shape {
  std::vector<geom::Vec2> corners;  ///< counter-clockwise
  std::vector<geom::Vec2> normals;  ///< outward, of the face from each corner to the next
  std::vector<double> offsets;      ///< of the face from the origin, along its normal
  geom::Vec2 middle;                ///< of the circle below
  double radius = 0.0;              ///< of a circle that contains the footprint
  double facing = 1.0;  ///< cosine of the largest angle between any direction and the nearest normal

  explicit Shape(std::span<const geom::Vec2> footprint);
};

/// A footprint in the world: the rear axle and the unit heading.
struct Stand {
  geom::Vec2 position, direction;
};

/// ∂/∂ of both.
struct StandGradient {
  geom::Vec2 position_a, direction_a, position_b, direction_b;
};

/// The letter's signed distance of two convex polygons, the largest separating gap over the face normals of
/// both [Pei24],
///   max( max_e min_o n_e·(v_o − v_e), max_o min_e n_o·(v_e − v_o) ),
/// with minimum and maximum smoothed by log-sum-exp of sharpness α (1/m). The minimum errs downwards by at
/// most log(corners)/α, the maximum upwards by at most smoothing_error(): taken off, the result is a lower
/// bound of the gap, and so of the distance.
double smooth_distance(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b,
                       double alpha, StandGradient& gradient);

/// m, log(faces of both) / α.
double smoothing_error(const Shape& a, const Shape& b, double alpha);

/// Where the gap may be less than `wanted` (m) at all: false when the circles are too far apart for that.
/// Some face normal deviates from the line between the middles by no more than the angle of `facing`.
bool may_be_near(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b, double wanted);

/// The gap without smoothing.
double hard_distance(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b);

}  // namespace seine::baseline::letter
