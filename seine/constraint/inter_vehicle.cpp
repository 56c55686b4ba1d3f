#include "seine/constraint/inter_vehicle.hpp"

#include "seine/base/simd.hpp"

namespace seine::constraint {
namespace {

// Everything below happens in the frame of box a: its middle is the origin, its heading the x axis.

// Half a box's length and width as vectors.
struct HalfAxes {
  double length_x, length_y, width_x, width_y;
};

// The corner of one box that is nearest to another box, and how far it is.
struct Nearest {
  double squared = 1e300, x = 0.0, y = 0.0;
};

[[gnu::always_inline]] inline double beyond(double x, double half) {
  const double outside = std::abs(x) - half;
  return outside > 0.0 ? outside : 0.0;
}

// @param x,y middle of the corners' box, from the middle and in the axes of the other  @param axes of the
// corners' box  @param half_length,half_width of the other
[[gnu::always_inline]] inline Nearest nearest(double x, double y, const HalfAxes& axes, double half_length,
                                              double half_width) {
  Nearest best;
  for (int corner = 0; corner < 4; ++corner) {
    const double along = corner < 2 ? -1.0 : 1.0, across = corner % 2 == 0 ? -1.0 : 1.0;
    const double cx = x + along * axes.length_x + across * axes.width_x,
                 cy = y + along * axes.length_y + across * axes.width_y;
    const double dx = beyond(cx, half_length), dy = beyond(cy, half_width);
    const double squared = dx * dx + dy * dy;
    const bool nearer = squared < best.squared;
    best.squared = nearer ? squared : best.squared;
    best.x = nearer ? cx : best.x;
    best.y = nearer ? cy : best.y;
  }
  return best;
}

// A distance, the unit vector from a to b along which it is measured, and the corner it is measured at.
struct Contact {
  double gap, nx, ny, x, y;
};

// Boxes apart: the nearest corner of either. The inverse of the distance is bounded so that lanes of touching
// boxes, which are discarded, stay finite.
[[gnu::always_inline]] inline Contact corner_contact(double x, double y, double c, double s,
                                                     const HalfAxes& axes_b, double length_a, double width_a,
                                                     double length_b, double width_b) {
  const Nearest of_b = nearest(x, y, axes_b, length_a, width_a);
  const HalfAxes axes_a{length_a * c, -length_a * s, width_a * s, width_a * c};
  const Nearest of_a = nearest(-x * c - y * s, x * s - y * c, axes_a, length_b, width_b);
  const bool b_is_nearest = of_b.squared <= of_a.squared;
  const double squared = b_is_nearest ? of_b.squared : of_a.squared;
  const double px = b_is_nearest ? of_b.x : of_a.x, py = b_is_nearest ? of_b.y : of_a.y;
  const double dx = std::copysign(beyond(px, b_is_nearest ? length_a : length_b), px),
               dy = std::copysign(beyond(py, b_is_nearest ? width_a : width_b), py);
  const double distance = std::sqrt(squared), inverse = 1.0 / (distance > 1e-12 ? distance : 1e-12);
  // A corner of a is known in the frame of b; back with it.
  return {distance, inverse * (b_is_nearest ? dx : s * dy - c * dx),
          inverse * (b_is_nearest ? dy : -s * dx - c * dy), b_is_nearest ? px : x + c * px - s * py,
          b_is_nearest ? py : y + s * px + c * py};
}

// Boxes that overlap: the face normal with the largest (least negative) gap, and the other box's corner that
// reaches furthest through the face.
[[gnu::always_inline]] inline Contact face_contact(double x, double y, double c, double s,
                                                   const HalfAxes& axes_b, double length_a, double width_a,
                                                   double length_b, double width_b) {
  const double abs_c = std::abs(c), abs_s = std::abs(s), xb = x * c + y * s, yb = y * c - x * s;
  const double gap_0 = std::abs(x) - length_a - (length_b * abs_c + width_b * abs_s),
               gap_1 = std::abs(y) - width_a - (length_b * abs_s + width_b * abs_c),
               gap_2 = std::abs(xb) - length_b - (length_a * abs_c + width_a * abs_s),
               gap_3 = std::abs(yb) - width_b - (length_a * abs_s + width_a * abs_c);
  const double sign_x = std::copysign(1.0, x), sign_y = std::copysign(1.0, y),
               sign_xb = std::copysign(1.0, xb), sign_yb = std::copysign(1.0, yb);
  const bool across_a = gap_1 > gap_0, across_b = gap_3 > gap_2;
  const double gap_a = across_a ? gap_1 : gap_0, gap_b = across_b ? gap_3 : gap_2;
  const bool of_a = gap_a >= gap_b;
  const double ax = across_a ? 0.0 : sign_x, ay = across_a ? sign_y : 0.0;
  const double bx = across_b ? -s * sign_yb : c * sign_xb, by = across_b ? c * sign_yb : s * sign_xb;
  const double nx = of_a ? ax : bx, ny = of_a ? ay : by;
  const double along = -std::copysign(1.0, nx * axes_b.length_x + ny * axes_b.length_y),
               across = -std::copysign(1.0, nx * axes_b.width_x + ny * axes_b.width_y);
  const double corner_x = x + along * axes_b.length_x + across * axes_b.width_x,
               corner_y = y + along * axes_b.length_y + across * axes_b.width_y;
  return {of_a ? gap_a : gap_b, nx, ny, of_a ? corner_x : std::copysign(length_a, nx),
          of_a ? corner_y : std::copysign(width_a, ny)};
}

[[gnu::always_inline]] inline void block(PairLanes& lanes, int begin) {
#pragma omp simd
  for (int j = begin; j < begin + PairLanes::kBlock; ++j) {
    const double ax = lanes.direction_ax[j], ay = lanes.direction_ay[j], bx = lanes.direction_bx[j],
                 by = lanes.direction_by[j];
    const double apart_x = lanes.apart_x[j], apart_y = lanes.apart_y[j];
    const double x = apart_x * ax + apart_y * ay, y = apart_y * ax - apart_x * ay;
    const double c = ax * bx + ay * by, s = ax * by - ay * bx;
    const double length_a = lanes.length_a[j], width_a = lanes.width_a[j], length_b = lanes.length_b[j],
                 width_b = lanes.width_b[j];
    const HalfAxes axes_b{length_b * c, length_b * s, -width_b * s, width_b * c};
    const Contact face = face_contact(x, y, c, s, axes_b, length_a, width_a, length_b, width_b);
    const Contact corner = corner_contact(x, y, c, s, axes_b, length_a, width_a, length_b, width_b);
    // Boxes that touch have no corner direction; the face's is the limit.
    const bool separated = face.gap > 0.0 && corner.gap > 1e-12;
    const double nx = separated ? corner.nx : face.nx, ny = separated ? corner.ny : face.ny;
    const double px = separated ? corner.x : face.x, py = separated ? corner.y : face.y;
    lanes.gap[j] = separated ? corner.gap : face.gap;
    lanes.normal_x[j] = nx * ax - ny * ay, lanes.normal_y[j] = nx * ay + ny * ax;
    // Both witnesses lie on the line through the corner along the normal: turning a car about its reference
    // point moves its own by the lever of that line.
    const double arm_x = px + lanes.offset_a[j], back_x = px - x + lanes.offset_b[j] * c,
                 back_y = py - y + lanes.offset_b[j] * s;
    lanes.turn_a[j] = py * nx - arm_x * ny;
    lanes.turn_b[j] = back_x * ny - back_y * nx;
  }
}

// Lanes without a pair get one that does no harm.
[[gnu::always_inline]] inline void pad(PairLanes& lanes, int count) {
  for (PairLanes::Row* row : {&lanes.apart_x, &lanes.apart_y, &lanes.direction_ax, &lanes.direction_ay,
                              &lanes.direction_bx, &lanes.direction_by, &lanes.offset_a, &lanes.length_a,
                              &lanes.width_a, &lanes.offset_b, &lanes.length_b, &lanes.width_b})
    for (int j = count; j % PairLanes::kBlock != 0; ++j) (*row)[j] = 1.0;
}

}  // namespace

SEINE_WIDEST
void inter_vehicle(PairLanes& lanes, int count) {
  pad(lanes, count);
  for (int begin = 0; begin < count; begin += PairLanes::kBlock) block(lanes, begin);
}

}  // namespace seine::constraint
