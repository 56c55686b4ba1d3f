#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "seine/geom/vec2.hpp"
#include "seine/traj/trajectory.hpp"

// The formula of docs/plan-format.md, in one place: whatever evaluates a plan (export, plot, simulation,
// certificate) comes here.
namespace seine::traj {

inline double value_at(const Quintic& c, double w) {
  return c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5]))));
}

inline double slope_at(const Quintic& c, double w) {
  return c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5])));
}

/// A quintic's value and first three derivatives by its local parameter.
inline std::array<double, 4> derivatives_at(const Quintic& c, double w) {
  return {value_at(c, w), slope_at(c, w), 2.0 * c[2] + w * (6.0 * c[3] + w * (12.0 * c[4] + w * 20.0 * c[5])),
          6.0 * c[3] + w * (24.0 * c[4] + w * 60.0 * c[5])};
}

/// Of `count` pieces of unit length, the one that holds `parameter`. A knot belongs to the piece on its
/// right; the first and the last piece go on beyond their outer ends.
inline std::size_t piece_at(double parameter, std::size_t count) {
  if (!(parameter > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(parameter, static_cast<double>(count))), count - 1);
}

/// Position and derivatives by u of the curve, and the progress, at one instant.
struct Flow {
  geom::Vec2 p, p1, p2, p3;        ///< p(u), p′, p″, p‴, m
  double u = 0.0;                  ///< local: since the curve piece began
  double rate = 0.0, rate2 = 0.0;  ///< u̇ in 1/s, ü in 1/s²
};

/// What follows from a flow, as in State.
struct Rates {
  double length = 0.0;  ///< m = |p′|, m
  double speed = 0.0, acceleration = 0.0, lateral_acceleration = 0.0;
  double curvature = 0.0, curvature_rate = 0.0;
};

/// One quintic of the curve driven by one quintic of the progress. Refers to the segment's coefficients.
struct Drive {
  const Quintic* x = nullptr;
  const Quintic* y = nullptr;
  const Quintic* progress = nullptr;
  double knot = 0.0;  ///< u where the curve piece begins
  double h = 1.0;     ///< s, duration of the progress piece
  double gear = 1.0;  ///< η

  /// p and p′ alone. @param w local parameter of the progress piece, in [0, 1]
  std::array<geom::Vec2, 2> place(double w) const {
    const double u = value_at(*progress, w) - knot;
    return {geom::Vec2{value_at(*x, u), value_at(*y, u)}, geom::Vec2{slope_at(*x, u), slope_at(*y, u)}};
  }
  Flow flow(double w) const {
    const auto q = derivatives_at(*progress, w);
    const double u = q[0] - knot;
    const auto a = derivatives_at(*x, u), b = derivatives_at(*y, u);
    return {{a[0], b[0]}, {a[1], b[1]}, {a[2], b[2]}, {a[3], b[3]}, u, q[1] / h, q[2] / (h * h)};
  }

  /// v = η m u̇, a_t = η (m ü + (p′·p″/m) u̇²), κ = η (p′ × p″)/m³, a_n = κ v².
  Rates rates(const Flow& f) const {
    const double m = geom::norm(f.p1), along = geom::dot(f.p1, f.p2), across = geom::cross(f.p1, f.p2);
    Rates r;
    r.length = m;
    r.speed = gear * m * f.rate;
    r.acceleration = gear * (m * f.rate2 + along / m * f.rate * f.rate);
    r.curvature = gear * across / (m * m * m);
    r.lateral_acceleration = r.curvature * r.speed * r.speed;
    const double by_u = (geom::cross(f.p1, f.p3) - 3.0 * across * along / (m * m)) / (m * m * m);
    r.curvature_rate = gear * by_u * f.rate;
    return r;
  }
};

/// Progress piece `j` on the curve piece `i`.
inline Drive drive_on(const Segment& segment, std::size_t j, std::size_t i) {
  const auto& piece = segment.curve[i];
  return {.x = &piece[0],
          .y = &piece[1],
          .progress = &segment.progress[j],
          .knot = static_cast<double>(i),
          .h = segment.piece_duration,
          .gear = segment.gear >= 0 ? 1.0 : -1.0};
}

/// Progress piece `j` on the curve piece that holds `u`.
inline Drive drive_at(const Segment& segment, std::size_t j, double u) {
  return drive_on(segment, j, piece_at(u, segment.curve.size()));
}

}  // namespace seine::traj
