#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// A rectangular footprint in the world: the car's reference point, its unit heading, and the rectangle in
/// the body frame.
struct OrientedBox {
  geom::Vec2 position;
  geom::Vec2 direction;
  double offset;  ///< of the rectangle's middle along the heading
  double half_length;
  double half_width;
};

/// ∂/∂ of both cars' position and direction.
struct PairGradient {
  geom::Vec2 position_a, direction_a, position_b, direction_b;
};

/// A rectangle's axes and middle in the world.
struct BoxFrame {
  geom::Vec2 middle, along, across;
  double half_length, half_width;
};

inline BoxFrame frame_of(const OrientedBox& box) {
  const geom::Vec2 across{-box.direction.y, box.direction.x};
  return {box.position + box.offset * box.direction, box.direction, across, box.half_length, box.half_width};
}

/// A corner of one box and its nearest point on the other, when the boxes are apart.
struct NearestCorner {
  double squared = 1e300;
  geom::Vec2 corner;  ///< signs of the corner along and across its own box
  geom::Vec2 normal;  ///< from the other box to the corner, not normalised
};

inline NearestCorner nearest_corner(const BoxFrame& owner, const BoxFrame& other) {
  const auto outside = [](double x, double half) {
    const double beyond = std::abs(x) - half;
    return beyond > 0.0 ? std::copysign(beyond, x) : 0.0;
  };
  // In the other box's axes: the middle, and half the owner's length and width.
  const geom::Vec2 delta = owner.middle - other.middle;
  const double mx = geom::dot(delta, other.along), my = geom::dot(delta, other.across);
  const double c = geom::dot(owner.along, other.along), s = geom::dot(owner.along, other.across);
  const double lx = owner.half_length * c, ly = owner.half_length * s;
  const double wx = -owner.half_width * s, wy = owner.half_width * c;
  NearestCorner best;
  double best_x = 0.0, best_y = 0.0;
  for (const double sl : {-1.0, 1.0})
    for (const double sw : {-1.0, 1.0}) {
      const double dx = outside(mx + sl * lx + sw * wx, other.half_length);
      const double dy = outside(my + sl * ly + sw * wy, other.half_width);
      const double squared = dx * dx + dy * dy;
      if (squared >= best.squared) continue;
      best.squared = squared;
      best.corner = {sl, sw};
      best_x = dx, best_y = dy;
    }
  best.normal = best_x * other.along + best_y * other.across;
  return best;
}

/// Penetrating boxes: the letter's signed distance of two convex polygons [Pei24], for rectangles in closed
/// form: the largest (least negative) gap over the four face normals, along a face normal e of a  |δ·e| − h_e
/// − (H_b |e·d_b| + W_b |e·n_b|),  δ = middle of b − middle of a.
/// @param face_to_corner receives whether the other box's nearest corner lies over the face, so that the gap
/// is the Euclidean distance
inline double separating_gap(const OrientedBox& a, const OrientedBox& b, PairGradient& gradient,
                             bool& face_to_corner) {
  using geom::cross, geom::dot, geom::Vec2;
  const Vec2 da = a.direction, db = b.direction, na{-da.y, da.x}, nb{-db.y, db.x};
  const Vec2 delta = (b.position + b.offset * db) - (a.position + a.offset * da);
  const double C = dot(da, db), S = cross(da, db), abs_c = std::abs(C), abs_s = std::abs(S);
  const double along_a = dot(delta, da), across_a = dot(delta, na), along_b = dot(delta, db),
               across_b = dot(delta, nb);
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

  // The corner of the other box that reaches furthest towards the face, along the face's tangent.
  const OrientedBox& owner = of_a ? a : b;
  const Vec2 towards = of_a ? -axis : axis, tangent{-towards.y, towards.x};
  const Vec2 along = of_a ? db : da, across = of_a ? nb : na;
  const Vec2 reach = std::copysign(other.half_length, dot(along, towards)) * along +
                     std::copysign(other.half_width, dot(across, towards)) * across;
  const Vec2 corner = of_a ? delta + reach : reach - delta;  // from the middle of the face's owner
  face_to_corner = std::abs(dot(corner, tangent)) <= (lengthwise ? owner.half_width : owner.half_length);
  return gap[face];
}

/// The signed distance of two rectangular footprints: Euclidean when they are apart (a corner of one is
/// nearest to the other), minus the smallest penetration along a face normal when they overlap. Continuous;
/// kinked where the nearest features change, which the line search copes with. The separating gap alone would
/// be a lower bound that dips sharply, and between samples unseen, when corners pass each other.
inline double inter_vehicle(const OrientedBox& a, const OrientedBox& b, PairGradient& gradient) {
  bool face_to_corner;
  const double gap = separating_gap(a, b, gradient, face_to_corner);
  if (gap <= 0.0 || face_to_corner) return gap;
  const BoxFrame fa = frame_of(a), fb = frame_of(b);
  const NearestCorner of_a = nearest_corner(fa, fb), of_b = nearest_corner(fb, fa);
  const bool corner_of_a = of_a.squared < of_b.squared;
  const NearestCorner& nearest = corner_of_a ? of_a : of_b;
  const double distance = std::sqrt(nearest.squared);
  // Unit from b to a, and the two witnesses relative to the cars' reference points; both ride with their cars
  // (envelope theorem).
  const geom::Vec2 normal = ((corner_of_a ? 1.0 : -1.0) / distance) * nearest.normal;
  const BoxFrame& owner = corner_of_a ? fa : fb;
  const geom::Vec2 corner = owner.middle + nearest.corner.x * owner.half_length * owner.along +
                            nearest.corner.y * owner.half_width * owner.across;
  const geom::Vec2 foot = corner - nearest.normal;
  const geom::Vec2 arm_a = (corner_of_a ? corner : foot) - a.position,
                   arm_b = (corner_of_a ? foot : corner) - b.position;
  // ∂/∂d of n·(R(d) c), c the arm in the body frame.
  const auto turn = [](geom::Vec2 n, geom::Vec2 arm, geom::Vec2 d) {
    const geom::Vec2 c{geom::dot(d, arm), geom::cross(d, arm)};
    return geom::Vec2{c.x * n.x + c.y * n.y, c.x * n.y - c.y * n.x};
  };
  gradient = {normal, turn(normal, arm_a, a.direction), -normal, turn(-normal, arm_b, b.direction)};
  return distance;
}

/// Pairs side by side, the same signed distance without a branch. In: the boxes, where b's middle lies from
/// a's. Out: the gap and its gradient in the form that a contact has: along the normal, and by the headings.
struct PairLanes {
  static constexpr int kLanes = 32;
  static constexpr int kBlock = 8;  ///< lanes computed at once
  using Row = double[kLanes];
  alignas(64) Row apart_x, apart_y;  ///< middle of b − middle of a
  alignas(64) Row direction_ax, direction_ay, direction_bx, direction_by;
  alignas(64) Row offset_a, length_a, width_a, offset_b, length_b,
      width_b;                              ///< offset; half length and width
  alignas(64) Row gap, normal_x, normal_y;  ///< normal: ∂gap/∂position of b, and minus that of a
  alignas(64) Row turn_a, turn_b;           ///< ∂gap/∂heading
};
/// Lays a pair into lane j.
inline void put(const OrientedBox& a, const OrientedBox& b, PairLanes& lanes, std::size_t j) {
  const geom::Vec2 apart = (b.position + b.offset * b.direction) - (a.position + a.offset * a.direction);
  lanes.apart_x[j] = apart.x, lanes.apart_y[j] = apart.y;
  lanes.direction_ax[j] = a.direction.x, lanes.direction_ay[j] = a.direction.y;
  lanes.direction_bx[j] = b.direction.x, lanes.direction_by[j] = b.direction.y;
  lanes.offset_a[j] = a.offset, lanes.length_a[j] = a.half_length, lanes.width_a[j] = a.half_width;
  lanes.offset_b[j] = b.offset, lanes.length_b[j] = b.half_length, lanes.width_b[j] = b.half_width;
}
/// @param count of pairs present, from lane 0; what follows them in the last block is overwritten
void inter_vehicle(PairLanes& lanes, int count);

}  // namespace seine::constraint
