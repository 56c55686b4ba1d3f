#pragma once

#include <cmath>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// A rectangular footprint in the world: the car's reference point, its unit heading, and the rectangle in the body frame.
struct OrientedBox {
  geom::Vec2 position;
  geom::Vec2 direction;
  double offset;       ///< of the rectangle's middle along the heading
  double half_length;
  double half_width;
};

/// ∂/∂ of both cars' position and direction.
struct PairGradient {
  geom::Vec2 position_a, direction_a, position_b, direction_b;
};

/// The letter's signed distance of two convex polygons [Pei24], for rectangles in closed form: the largest separating gap over the four face
/// normals,
///   along a face normal e of a:  |δ·e| − h_e − (H_b |e·d_b| + W_b |e·n_b|),   δ = middle of b − middle of a,
/// and likewise for b. A lower bound of the Euclidean distance, equal to it unless two corners are closest; minus the penetration when
/// they overlap. The maximum is kept hard: the line search copes with the kink, and nothing has to be taken off the margin.
inline double inter_vehicle(const OrientedBox& a, const OrientedBox& b, PairGradient& gradient) {
  using geom::cross, geom::dot, geom::Vec2;
  const Vec2 da = a.direction, db = b.direction, na{-da.y, da.x}, nb{-db.y, db.x};
  const Vec2 delta = (b.position + b.offset * db) - (a.position + a.offset * da);
  const double C = dot(da, db), S = cross(da, db), abs_c = std::abs(C), abs_s = std::abs(S);
  const double along_a = dot(delta, da), across_a = dot(delta, na), along_b = dot(delta, db), across_b = dot(delta, nb);
  const double gap[4] = {std::abs(along_a) - a.half_length - (b.half_length * abs_c + b.half_width * abs_s),
                         std::abs(across_a) - a.half_width - (b.half_length * abs_s + b.half_width * abs_c),
                         std::abs(along_b) - b.half_length - (a.half_length * abs_c + a.half_width * abs_s),
                         std::abs(across_b) - b.half_width - (a.half_length * abs_s + a.half_width * abs_c)};
  int face = 0;
  for (int i = 1; i < 4; ++i)
    if (gap[i] > gap[face]) face = i;

  const double sign_c = C < 0.0 ? -1.0 : 1.0, sign_s = S < 0.0 ? -1.0 : 1.0;
  const bool of_a = face < 2, lengthwise = face % 2 == 0;
  const OrientedBox& other = of_a ? b : a;
  // ∂/∂C and ∂/∂S of the projected half extent of the other box.
  const double g_c = -sign_c * (lengthwise ? other.half_length : other.half_width);
  const double g_s = -sign_s * (lengthwise ? other.half_width : other.half_length);
  const double projection = lengthwise ? (of_a ? along_a : along_b) : (of_a ? across_a : across_b);
  const double sign = projection < 0.0 ? -1.0 : 1.0;
  const Vec2 axis = sign * (lengthwise ? (of_a ? da : db) : (of_a ? na : nb));  // ∂/∂δ
  // ∂/∂ of the direction that owns the axis: δ·d has gradient δ, δ·n has gradient (δ_y, −δ_x).
  const Vec2 turn = sign * (lengthwise ? delta : Vec2{delta.y, -delta.x});
  gradient.position_a = -axis;
  gradient.position_b = axis;
  gradient.direction_a = -a.offset * axis + g_c * db + g_s * Vec2{db.y, -db.x};
  gradient.direction_b = b.offset * axis + g_c * da + g_s * Vec2{-da.y, da.x};
  (of_a ? gradient.direction_a : gradient.direction_b) += turn;
  return gap[face];
}

}  // namespace seine::constraint
