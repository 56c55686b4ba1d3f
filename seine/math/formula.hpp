#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/math/finite_difference.hpp"

namespace seine::math {

/// Something with a gradient as a plain function of numbers, so that one test can check all of its kind.
struct Formula {
  std::string name;
  int inputs;
  std::function<double(std::span<const double> x, std::span<double> gradient)> value;
  std::function<void(Rng&, std::span<double> x)> draw;  ///< a random point
};

/// Gradient against central differences at random points.
struct FormulaCheck {
  int near_a_kink = 0;  ///< points where they differ by more than the tolerance
  double worst = 0.0;   ///< at all others
};
inline FormulaCheck check_gradients(const Formula& formula, std::uint64_t seed, int points,
                                    double tolerance = 1e-6) {
  Rng rng(seed);
  FormulaCheck result;
  std::vector<double> x(static_cast<std::size_t>(formula.inputs)), g(x.size()), unused(x.size());
  const auto f = [&](std::span<const double> y) { return formula.value(y, unused); };
  for (int i = 0; i < points; ++i) {
    formula.draw(rng, x);
    std::ranges::fill(g, 0.0);
    formula.value(x, g);
    const double error = check_gradient(f, x, g).worst;
    if (error > tolerance)
      ++result.near_a_kink;
    else
      result.worst = std::max(result.worst, error);
  }
  return result;
}

/// What the check makes of gradients of which one entry is wrong by a thousandth: the smallest error it sees.
inline double least_planted_error_seen(const Formula& formula, std::uint64_t seed) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> x(static_cast<std::size_t>(formula.inputs)), g(x.size()), unused(x.size());
  const auto f = [&](std::span<const double> y) { return formula.value(y, unused); };
  for (double& wrong : g) {
    Rng rng(seed);
    formula.draw(rng, x);
    std::ranges::fill(g, 0.0);
    formula.value(x, g);
    wrong += 1e-3 * (1.0 + std::abs(wrong));
    least = std::min(least, check_gradient(f, x, g).worst);
  }
  return least;
}

}  // namespace seine::math
