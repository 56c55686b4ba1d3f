// The chain rule from samples to one car's decision variables.
#include <algorithm>

#include "seine/traj/minco.hpp"
#include "seine/trajopt/robot_problem.hpp"

namespace seine::trajopt {

using geom::Vec2;

void RobotProblem::pull_back(const ClockState& c) {
  const Moment& at_time = c.moment;
  Segment& s = segments_[static_cast<std::size_t>(at_time.segment)];
  const Vec2 g1 =
      (s.gear * c.inverse_m) * (c.g_direction - geom::dot(c.g_direction, c.direction) * c.direction);
  double power = 1.0, slope = 0.0;  // w^k, k w^(k−1)
  for (int k = 0; k < 6; ++k) {
    const auto at = static_cast<std::size_t>(k * pieces_ + c.piece);
    gcx_[at] += c.g_position.x * power + g1.x * slope;
    gcy_[at] += c.g_position.y * power + g1.y * slope;
    slope = (k + 1) * power;
    power *= c.w;
  }
  const double g_u = geom::dot(c.g_position, c.d1) + geom::dot(g1, c.d2);
  power = 1.0;
  for (int k = 0; k < 6; ++k) {
    gcu_[static_cast<std::size_t>(k * time_pieces_ + at_time.time_piece)] += g_u * power;
    power *= at_time.wt;
  }
  // The clock is absolute: a longer piece, or a later start, leaves the car further back at the same instant.
  s.g_h -= g_u * c.u1 * at_time.rho;
  s.g_start -= g_u * c.u1;
}

void RobotProblem::gradient(std::span<double> g) {
  std::fill(g.begin(), g.end(), 0.0);
  // Start times: start_i = Σ_{k<i} (wait_k + T_k) + wait_i, and the price of time itself is on the last
  // arrival.
  double later = 0.0;
  for (std::size_t i = segments_.size(); i-- > 0;) {
    Segment& s = segments_[i];
    s.g_h += later * s.time_pieces;
    later += s.g_start;
    if (s.wait >= 0) {
      const double before =
          i == 0 ? 0.0 : segments_[i - 1].start + segments_[i - 1].h * segments_[i - 1].time_pieces;
      g[static_cast<std::size_t>(s.wait)] = (1.0 + later) * (s.start - before);
    }
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) pull_segment(i, g);
  for (const Segment& s : segments_) {
    g[static_cast<std::size_t>(s.length)] = s.g_l * s.l;
    g[static_cast<std::size_t>(s.duration)] = s.g_h * s.h;
  }
  for (std::size_t r = 0; r < rests_.size(); ++r) {
    const Rest& rest = rests_[r];
    if (rest.pose_variable >= 0) {
      g[static_cast<std::size_t>(rest.pose_variable)] = rest.g_x;
      g[static_cast<std::size_t>(rest.pose_variable + 1)] = rest.g_y;
      g[static_cast<std::size_t>(rest.pose_variable + 2)] = rest.g_heading;
    }
    g[static_cast<std::size_t>(rest.curvature_variable)] = rest.g_kappa * kappa_unit_;
    g[static_cast<std::size_t>(rest.acceleration_variable)] =
        r == 0 && moving_start() ? rest.g_alpha : rest.g_alpha * rest.alpha;
  }
  for (std::size_t i = 0; i < scale_.size(); ++i) g[i] *= scale_[i];
}

void RobotProblem::pull_segment(std::size_t index, std::span<double> g) {
  Segment& s = segments_[index];
  Rest &a = rests_[index], &b = rests_[index + 1];
  std::array<std::array<double, traj::UniformMinco::kMaxPieces + 5>, 2> z{};
  const auto rows = static_cast<std::size_t>(s.pieces + 5);
  const auto& curve = traj::UniformMinco::with(s.pieces);
  curve.add_adjoint(gcx_.data() + s.piece_begin, pieces_, {z[0].data(), rows});
  curve.add_adjoint(gcy_.data() + s.piece_begin, pieces_, {z[1].data(), rows});
  for (int j = 1; j < s.pieces; ++j)
    for (std::size_t axis = 0; axis < 2; ++axis)
      g[static_cast<std::size_t>(s.knots + 2 * (j - 1)) + axis] = z[axis][static_cast<std::size_t>(j + 2)];

  const auto boundary = [&](Rest& rest, std::size_t row) {
    const Vec2 d = rest.now.direction(), n = geom::left_normal(d);
    const Vec2 g0{z[0][row], z[1][row]}, g1{z[0][row + 1], z[1][row + 1]}, g2{z[0][row + 2], z[1][row + 2]};
    rest.g_x += g0.x, rest.g_y += g0.y;
    rest.g_heading += s.gear * s.l * geom::dot(n, g1) - rest.kappa * s.l * s.l * geom::dot(d, g2);
    rest.g_kappa += s.l * s.l * geom::dot(n, g2);
    s.g_l += s.gear * geom::dot(d, g1) + 2.0 * rest.kappa * s.l * geom::dot(n, g2);
  };
  boundary(a, 0);
  boundary(b, static_cast<std::size_t>(s.pieces + 2));

  std::array<double, traj::UniformMinco::kMaxPieces + 5> zu{};
  traj::UniformMinco::with(s.time_pieces)
      .add_adjoint(gcu_.data() + s.time_begin, time_pieces_,
                   {zu.data(), static_cast<std::size_t>(s.time_pieces + 5)});
  for (int j = 1; j < s.time_pieces; ++j)
    g[static_cast<std::size_t>(s.progress + j - 1)] = zu[static_cast<std::size_t>(j + 2)];
  const double scale = s.h * s.h / s.l, g_start = zu[2],
               g_end = -zu[static_cast<std::size_t>(s.time_pieces + 4)];
  a.g_alpha += scale * g_start;
  b.g_alpha += scale * g_end;
  const double both = a.alpha * g_start + b.alpha * g_end;
  s.g_h += 2.0 * s.h / s.l * both;
  s.g_l -= scale / s.l * both;
  if (index == 0 && moving_start()) {
    s.g_h += start_speed_ / s.l * zu[1];
    s.g_l -= start_speed_ * s.h / (s.l * s.l) * zu[1];
  }
}

}  // namespace seine::trajopt
