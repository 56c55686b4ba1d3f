// The cost of one car by itself: time, smoothness, limits, corridor.
#include <algorithm>
#include <cmath>

#include "seine/constraint/corridor.hpp"
#include "seine/constraint/curvature.hpp"
#include "seine/constraint/steering_rate.hpp"
#include "seine/constraint/tangential_acceleration.hpp"
#include "seine/math/hinge.hpp"
#include "seine/traj/minco.hpp"
#include "seine/trajopt/robot_problem.hpp"

namespace seine::trajopt {

using geom::Vec2;

double RobotProblem::evaluate(double knee) {
  double cost = arrival_;
  for (Segment& s : segments_) s.g_h += s.time_pieces;  // waits: see gradient()
  cost += limits(knee);
  cost += smoothness();
  cost += rest_cost(knee);
  return cost;
}

double RobotProblem::limits(double knee) {
  double cost = 0.0;
  for (Segment& s : segments_) {
    const CurveWeights curve{kappa_max_, s.l, knee, curve_weight_,
                             settings_.regularity / (kCurveLanes * pieces_)};
    CurveLanes lanes;
    for (int j = 0; j < s.pieces; ++j) {
      const int piece = s.piece_begin + j;
      cost += curve_piece(&cx_[static_cast<std::size_t>(piece)], &cy_[static_cast<std::size_t>(piece)],
                          pieces_, curve, lanes, s.g_l);
      cost += corridor_cost(piece, s, lanes, knee);
      curve_piece_adjoint(lanes, &gcx_[static_cast<std::size_t>(piece)],
                          &gcy_[static_cast<std::size_t>(piece)], pieces_);
    }
    const TimeWeights time{
        s.h,  s.speed_limit, model_.limits.acceleration, model_.limits.lateral_acceleration, least_speed_,
        knee, sample_weight_};
    const auto begin = static_cast<std::size_t>(s.piece_begin);
    const CurveView view{&cx_[begin], &cy_[begin], &gcx_[begin], &gcy_[begin], pieces_, s.pieces};
    for (int j = 0; j < s.time_pieces; ++j) {
      const auto piece = static_cast<std::size_t>(s.time_begin + j);
      cost += time_piece(&cu_[piece], &gcu_[piece], time_pieces_, view, time, s.g_h);
    }
    if (std::isfinite(model_.limits.steering_rate)) cost += steering_cost(s, knee, s.g_h);
  }
  return cost;
}

double RobotProblem::corridor_cost(int piece, const Segment& s, CurveLanes& lanes, double knee) const {
  double cost = 0.0;
  for (int lane = 0; lane < kCurveLanes; ++lane) {
    const auto sample = static_cast<std::size_t>(piece * kCurveLanes + lane),
               i = static_cast<std::size_t>(lane);
    if (!corridor_.bounds(sample)) continue;
    const Vec2 p{lanes.px[i], lanes.py[i]}, d1{lanes.d1x[i], lanes.d1y[i]};
    const double inverse = 1.0 / geom::norm(d1);
    const Vec2 d = (s.gear * inverse) * d1;
    Vec2 g_p, g_d;
    cost += planes_cost(sample, p, d, knee, g_p, g_d);
    lanes.gpx[i] += g_p.x, lanes.gpy[i] += g_p.y;
    const Vec2 g1 = (s.gear * inverse) * (g_d - geom::dot(g_d, d) * d);
    lanes.g1x[i] += g1.x, lanes.g1y[i] += g1.y;
  }
  return cost;
}

// The corridor at one sample; adds to the gradient by position and direction.
double RobotProblem::planes_cost(std::size_t sample, Vec2 p, Vec2 d, double knee, Vec2& g_p,
                                 Vec2& g_d) const {
  const double weight = settings_.corridor_penalty * curve_weight_;
  double cost = 0.0;
  for (int plane = corridor_.begin[sample]; plane < corridor_.begin[sample + 1]; ++plane) {
    const auto k = static_cast<std::size_t>(plane);
    const Vec2 normal{corridor_.nx[k], corridor_.ny[k]};
    if (geom::dot(normal, p) + reach_ <= corridor_.b[k]) continue;
    for (const Vec2 corner : footprint_) {
      Vec2 gp, gd;
      const double excess = constraint::corridor(p, d, corner, normal, corridor_.b[k], gp, gd);
      if (excess <= 0.0) continue;
      double slope;
      cost += weight * math::hinge(excess, knee, slope);
      g_p += (weight * slope) * gp;
      g_d += (weight * slope) * gd;
    }
  }
  return cost;
}

// Rarely asked for, so plain code at the samples of the time kernel.
double RobotProblem::steering_cost(const Segment& s, double knee, double& g_h) {
  double cost = 0.0;
  for (int j = 0; j < s.time_pieces; ++j)
    for (int lane = 0; lane < kTimeLanes; ++lane) {
      const double wt = static_cast<double>(lane) / kTimeLanes;
      const auto tp = static_cast<std::size_t>(s.time_begin + j);
      double u = 0.0, du = 0.0;
      for (int k = 5; k >= 0; --k)
        du = u + wt * du, u = cu_[static_cast<std::size_t>(k * time_pieces_) + tp] + wt * u;
      const int piece = u > 0.0 ? static_cast<int>(std::min(u, s.pieces - 1.0)) : 0;
      const double w = u - piece;
      double d[2][5] = {};  // value and four derivatives of x and y
      for (int axis = 0; axis < 2; ++axis)
        for (int k = 5; k >= 0; --k) {
          const double c =
              (axis == 0 ? cx_ : cy_)[static_cast<std::size_t>(k * pieces_ + s.piece_begin + piece)];
          for (int order = 4; order > 0; --order)
            d[axis][order] = order * d[axis][order - 1] + w * d[axis][order];
          d[axis][0] = c + w * d[axis][0];
        }
      constraint::SteeringSample g;
      const constraint::SteeringSample sample{d[0][1], d[1][1], d[0][2], d[1][2], d[0][3], d[1][3], du / s.h};
      const double excess =
          constraint::steering_rate(sample, model_.wheelbase, model_.limits.steering_rate, g);
      if (excess <= 0.0) continue;
      double slope;
      cost += sample_weight_ * math::hinge(excess, knee, slope);
      slope *= sample_weight_;
      double first[6] = {}, second[6] = {}, third[6] = {}, power = 1.0;
      for (int k = 1; k < 6; ++k) {
        first[k] = k * power;
        if (k + 1 < 6) second[k + 1] = (k + 1) * k * power;
        if (k + 2 < 6) third[k + 2] = (k + 2) * (k + 1) * k * power;
        power *= w;
      }
      for (int k = 1; k < 6; ++k) {
        const auto c = static_cast<std::size_t>(k * pieces_ + s.piece_begin + piece);
        gcx_[c] += slope * (g.d1x * first[k] + g.d2x * second[k] + g.d3x * third[k]);
        gcy_[c] += slope * (g.d1y * first[k] + g.d2y * second[k] + g.d3y * third[k]);
      }
      const double g_u = slope * (g.d1x * d[0][2] + g.d1y * d[1][2] + g.d2x * d[0][3] + g.d2y * d[1][3] +
                                  g.d3x * d[0][4] + g.d3y * d[1][4]);
      const double g_u1 = slope * g.u1 / s.h;
      power = 1.0;
      for (int k = 0; k < 6; ++k) {
        const auto c = static_cast<std::size_t>(k * time_pieces_) + tp;
        gcu_[c] += g_u * power;
        if (k + 1 < 6) gcu_[c + static_cast<std::size_t>(time_pieces_)] += g_u1 * (k + 1) * power;
        power *= wt;
      }
      g_h -= g_u1 * du / s.h;
    }
  return cost;
}

// ∫ (l u⃛)² dt over the progress, normalised by t_a = v_max/a_max, and ∫ |p'''|² du / l² over the curve.
double RobotProblem::smoothness() {
  double cost = 0.0;
  const double v = model_.limits.speed, a = model_.limits.acceleration, t_a = v / a;
  const double jerk = settings_.jerk * t_a / (a * a);
  for (Segment& s : segments_) {
    const double factor = jerk * s.l * s.l / std::pow(s.h, 5);
    for (int j = 0; j < s.time_pieces; ++j) {
      std::array<double, 6> c;
      const auto at = [&](std::size_t k) {
        return k * static_cast<std::size_t>(time_pieces_) + static_cast<std::size_t>(s.time_begin + j);
      };
      for (std::size_t k = 0; k < 6; ++k) c[k] = cu_[at(k)];
      const double energy = factor * traj::jerk_energy(c);
      const auto g = traj::jerk_energy_gradient(c);
      for (std::size_t k = 0; k < 3; ++k) gcu_[at(k + 3)] += factor * g[k];
      cost += energy;
      s.g_h -= 5.0 * energy / s.h;
      s.g_l += 2.0 * energy / s.l;
    }
    const double bend = settings_.curve_smoothness / (s.l * s.l);
    for (int j = 0; j < s.pieces; ++j)
      for (int axis = 0; axis < 2; ++axis) {
        const auto at = [&](std::size_t k) {
          return k * static_cast<std::size_t>(pieces_) + static_cast<std::size_t>(s.piece_begin + j);
        };
        std::array<double, 6> c;
        for (std::size_t k = 0; k < 6; ++k) c[k] = (axis == 0 ? cx_ : cy_)[at(k)];
        const double energy = bend * traj::jerk_energy(c);
        const auto g = traj::jerk_energy_gradient(c);
        for (std::size_t k = 0; k < 3; ++k) (axis == 0 ? gcx_ : gcy_)[at(k + 3)] += bend * g[k];
        cost += energy;
        s.g_l -= 2.0 * energy / s.l;
      }
  }
  return cost;
}

// The end of a segment is no sample of the kernels: there a_t = α and κ are variables themselves.
double RobotProblem::rest_cost(double knee) {
  double cost = 0.0;
  for (std::size_t r = 0; r < rests_.size(); ++r) {
    Rest& rest = rests_[r];
    double slope, d;
    const double excess = constraint::tangential_acceleration(rest.alpha, model_.limits.acceleration, d);
    cost += sample_weight_ * math::hinge(excess, knee, slope);
    rest.g_alpha += sample_weight_ * slope * d;
    const double bent = std::abs(rest.kappa) / kappa_max_ - 1.0;
    cost += curve_weight_ * math::hinge(bent, knee, slope);
    rest.g_kappa += curve_weight_ * slope * (rest.kappa < 0.0 ? -1.0 : 1.0) / kappa_max_;
  }
  return cost + end_cost(knee);
}

// Other rests are the first sample of the segment that follows; a given end is what it is.
double RobotProblem::end_cost(double knee) {
  Rest& end = rests_.back();
  const auto sample = static_cast<std::size_t>(pieces_ * kCurveLanes);
  if (end.pose_variable < 0 || !corridor_.bounds(sample)) return 0.0;
  const Vec2 d = end.now.direction();
  Vec2 g_p, g_d;
  const double cost = planes_cost(sample, end.now.position(), d, knee, g_p, g_d);
  end.g_x += g_p.x, end.g_y += g_p.y;
  end.g_heading += geom::dot(g_d, geom::left_normal(d));
  return cost;
}

}  // namespace seine::trajopt
