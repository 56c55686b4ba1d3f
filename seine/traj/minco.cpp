#include "seine/traj/minco.hpp"

#include <Eigen/Dense>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace seine::traj {
namespace {

// Continuity of the third and fourth derivative at knot j, written in value p, slope v and curvature a of
// knots j − 1, j, j + 1 (a quintic piece is its Hermite data):
//   −24 v₋ + 24 v₊ − 3 a₋ + 18 a − 3 a₊            = 60 p₋ − 120 p + 60 p₊
//   −168 v₋ − 384 v − 168 v₊ − 24 a₋ + 24 a₊       = 360 p₋ − 360 p₊
constexpr int kStart = 0;

int value_row(int knot, int pieces) {
  if (knot == 0) return kStart;
  return knot == pieces ? pieces + 2 : knot + 2;
}

Eigen::MatrixXd solve_inner(int pieces) {
  const int unknowns = 2 * (pieces - 1);
  Eigen::MatrixXd lhs = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(unknowns, pieces + 5);
  // Puts factor · (derivative `order` at `knot`) on the left, or on the right where the boundary gives it.
  const auto add = [&](int row, int knot, int order, double factor) {
    if (knot == 0)
      rhs(row, order) -= factor;
    else if (knot == pieces)
      rhs(row, pieces + 2 + order) -= factor;
    else
      lhs(row, 2 * (knot - 1) + order - 1) += factor;
  };
  for (int knot = 1; knot < pieces; ++knot) {
    const int third = 2 * (knot - 1), fourth = third + 1;
    add(third, knot - 1, 1, -24), add(third, knot + 1, 1, 24);
    add(third, knot - 1, 2, -3), add(third, knot, 2, 18), add(third, knot + 1, 2, -3);
    rhs(third, value_row(knot - 1, pieces)) += 60;
    rhs(third, value_row(knot, pieces)) += -120;
    rhs(third, value_row(knot + 1, pieces)) += 60;
    add(fourth, knot - 1, 1, -168), add(fourth, knot, 1, -384), add(fourth, knot + 1, 1, -168);
    add(fourth, knot - 1, 2, -24), add(fourth, knot + 1, 2, 24);
    rhs(fourth, value_row(knot - 1, pieces)) += 360;
    rhs(fourth, value_row(knot + 1, pieces)) += -360;
  }
  return lhs.partialPivLu().solve(rhs);
}

}  // namespace

UniformMinco::UniformMinco(int pieces) : pieces_(pieces) {
  if (pieces == 1) return;
  const Eigen::MatrixXd inner = solve_inner(pieces);
  inner_.resize(static_cast<std::size_t>(inner.size()));
  for (Eigen::Index r = 0; r < inner.rows(); ++r)
    for (Eigen::Index c = 0; c < inner.cols(); ++c)
      inner_[static_cast<std::size_t>(r * inner.cols() + c)] = inner(r, c);
}

const UniformMinco& UniformMinco::with(int pieces) {
  if (pieces < 1 || pieces > kMaxPieces)
    throw std::out_of_range("a spline has 1 to " + std::to_string(kMaxPieces) + " pieces, not " +
                            std::to_string(pieces));
  static std::array<std::unique_ptr<const UniformMinco>, kMaxPieces + 1> cache;
  static std::array<std::once_flag, kMaxPieces + 1> made;
  const auto index = static_cast<std::size_t>(pieces);
  std::call_once(made[index], [&] { cache[index].reset(new UniformMinco(pieces)); });
  return *cache[index];
}

void UniformMinco::coefficients(std::span<const double> z, double* out, int stride) const {
  std::array<double, 3 * (kMaxPieces + 1)> knots;  // (p, v, a) of each knot
  const int last = pieces_;
  for (int d = 0; d < 3; ++d) {
    knots[static_cast<std::size_t>(d)] = z[static_cast<std::size_t>(d)];
    knots[static_cast<std::size_t>(3 * last + d)] = z[static_cast<std::size_t>(last + 2 + d)];
  }
  const int columns = rows();
  for (int j = 1; j < last; ++j) {
    const double* row = &inner_[static_cast<std::size_t>(2 * (j - 1) * columns)];
    double v = 0.0, a = 0.0;
#pragma omp simd reduction(+ : v, a)
    for (int c = 0; c < columns; ++c) {
      v += row[c] * z[static_cast<std::size_t>(c)];
      a += row[columns + c] * z[static_cast<std::size_t>(c)];
    }
    knots[static_cast<std::size_t>(3 * j)] = z[static_cast<std::size_t>(j + 2)];
    knots[static_cast<std::size_t>(3 * j + 1)] = v;
    knots[static_cast<std::size_t>(3 * j + 2)] = a;
  }
  for (int j = 0; j < last; ++j) {
    const double* k = &knots[static_cast<std::size_t>(3 * j)];
    const double delta = k[3] - k[0], v0 = k[1], a0 = k[2], v1 = k[4], a1 = k[5];
    out[0 * stride + j] = k[0];
    out[1 * stride + j] = v0;
    out[2 * stride + j] = 0.5 * a0;
    out[3 * stride + j] = 10 * delta - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
    out[4 * stride + j] = -15 * delta + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
    out[5 * stride + j] = 6 * delta - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1;
  }
}

void UniformMinco::add_adjoint(const double* gradient, int stride, std::span<double> gradient_z) const {
  std::array<double, 3 * (kMaxPieces + 1)> knots{};
  const int last = pieces_;
  for (int j = 0; j < last; ++j) {
    const double* g = gradient + j;
    double* k = &knots[static_cast<std::size_t>(3 * j)];
    const double g3 = g[3 * stride], g4 = g[4 * stride], g5 = g[5 * stride];
    const double delta = 10 * g3 - 15 * g4 + 6 * g5;
    k[0] += g[0] - delta;
    k[1] += g[stride] - 6 * g3 + 8 * g4 - 3 * g5;
    k[2] += 0.5 * g[2 * stride] - 1.5 * g3 + 1.5 * g4 - 0.5 * g5;
    k[3] += delta;
    k[4] += -4 * g3 + 7 * g4 - 3 * g5;
    k[5] += 0.5 * g3 - g4 + 0.5 * g5;
  }
  for (int d = 0; d < 3; ++d) {
    gradient_z[static_cast<std::size_t>(d)] += knots[static_cast<std::size_t>(d)];
    gradient_z[static_cast<std::size_t>(last + 2 + d)] += knots[static_cast<std::size_t>(3 * last + d)];
  }
  const int columns = rows();
  for (int j = 1; j < last; ++j) {
    const double* row = &inner_[static_cast<std::size_t>(2 * (j - 1) * columns)];
    const double v = knots[static_cast<std::size_t>(3 * j + 1)],
                 a = knots[static_cast<std::size_t>(3 * j + 2)];
    gradient_z[static_cast<std::size_t>(j + 2)] += knots[static_cast<std::size_t>(3 * j)];
#pragma omp simd
    for (int c = 0; c < columns; ++c)
      gradient_z[static_cast<std::size_t>(c)] += v * row[c] + a * row[columns + c];
  }
}

}  // namespace seine::traj
