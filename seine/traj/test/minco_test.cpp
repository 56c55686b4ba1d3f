#include "seine/traj/minco.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"

namespace seine::traj {
namespace {

constexpr std::uint64_t kSeed = 77;

std::vector<double> random_vector(Rng& rng, int size) {
  std::vector<double> v(static_cast<std::size_t>(size));
  for (double& x : v) x = rng.normal();
  return v;
}

double derivative(const std::vector<double>& c, int pieces, int piece, int order, double w) {
  double sum = 0.0;
  for (int k = order; k < 6; ++k) {
    double factor = 1.0;
    for (int i = 0; i < order; ++i) factor *= k - i;
    sum += factor * c[static_cast<std::size_t>(k * pieces + piece)] * std::pow(w, k - order);
  }
  return sum;
}

TEST(UniformMinco, InterpolatesKeepsItsBoundaryAndIsFourTimesContinuous) {
  Rng rng(kSeed);
  for (int pieces = 1; pieces <= 40; ++pieces) {
    const auto& spline = UniformMinco::with(pieces);
    const std::vector<double> z = random_vector(rng, spline.rows());
    std::vector<double> c(static_cast<std::size_t>(6 * pieces));
    spline.coefficients(z, c.data(), pieces);
    for (int order = 0; order < 3; ++order) {
      EXPECT_NEAR(derivative(c, pieces, 0, order, 0.0), z[static_cast<std::size_t>(order)], 1e-9);
      EXPECT_NEAR(derivative(c, pieces, pieces - 1, order, 1.0),
                  z[static_cast<std::size_t>(pieces + 2 + order)], 1e-8);
    }
    for (int j = 1; j < pieces; ++j) {
      EXPECT_NEAR(derivative(c, pieces, j, 0, 0.0), z[static_cast<std::size_t>(j + 2)], 1e-9);
      for (int order = 0; order <= 4; ++order)
        EXPECT_NEAR(derivative(c, pieces, j - 1, order, 1.0), derivative(c, pieces, j, order, 0.0), 1e-6)
            << pieces << " pieces, knot " << j << ", derivative " << order << ", seed " << kSeed;
    }
  }
}

double energy(const std::vector<double>& c, int pieces) {
  double sum = 0.0;
  for (int j = 0; j < pieces; ++j) {
    std::array<double, 6> piece;
    for (std::size_t k = 0; k < 6; ++k)
      piece[k] = c[k * static_cast<std::size_t>(pieces) + static_cast<std::size_t>(j)];
    sum += jerk_energy(piece);
  }
  return sum;
}

// Of all curves through the same points with the same ends, the spline has the least jerk: bending a C² curve
// away from it by any admissible amount costs.
TEST(UniformMinco, HasLeastJerk) {
  Rng rng(kSeed);
  const int pieces = 6;
  const auto& spline = UniformMinco::with(pieces);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<double> z = random_vector(rng, spline.rows());
    std::vector<double> c(6 * pieces);
    spline.coefficients(z, c.data(), pieces);
    // w³(1−w)³ is zero with its first two derivatives at both ends; its quintic stand-in changes v and a at
    // one interior knot.
    std::vector<double> moved = c;
    const int knot = 1 + rng.below(pieces - 1);
    const double dv = 0.1 * rng.normal(), da = 0.1 * rng.normal();
    const auto add = [&](int piece, const std::array<double, 6>& d) {
      for (std::size_t k = 0; k < 6; ++k) moved[k * pieces + static_cast<std::size_t>(piece)] += d[k];
    };
    add(knot - 1, {0, 0, 0, -4 * dv + 0.5 * da, 7 * dv - da, -3 * dv + 0.5 * da});
    add(knot, {0, dv, 0.5 * da, -6 * dv - 1.5 * da, 8 * dv + 1.5 * da, -3 * dv - 0.5 * da});
    EXPECT_GT(energy(moved, pieces), energy(c, pieces)) << "seed " << kSeed << ", trial " << trial;
  }
}

TEST(UniformMinco, AdjointIsTheTransposeOfTheMap) {
  Rng rng(kSeed);
  for (const int pieces : {1, 2, 3, 7, 24}) {
    const auto& spline = UniformMinco::with(pieces);
    const std::vector<double> z = random_vector(rng, spline.rows()), g = random_vector(rng, 6 * pieces);
    std::vector<double> c(g.size()), gz(z.size(), 0.0);
    spline.coefficients(z, c.data(), pieces);
    spline.add_adjoint(g.data(), pieces, gz);
    double left = 0.0, right = 0.0, size = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) left += g[i] * c[i], size += std::abs(g[i] * c[i]);
    for (std::size_t i = 0; i < z.size(); ++i) right += gz[i] * z[i];
    EXPECT_NEAR(left, right, 1e-12 * size) << pieces;
  }
}

}  // namespace
}  // namespace seine::traj
