#include "seine/optim/lbfgs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"

namespace seine::optim {
namespace {

// Σ ½ λ_i (Q(x − m))_i² over a random chain of plane rotations Q: the minimum is m by construction.
struct Quadratic {
  std::vector<double> center, eigenvalue, angle;
  explicit Quadratic(std::uint64_t seed, int n) {
    Rng rng(seed);
    for (int i = 0; i < n; ++i) {
      center.push_back(rng.normal());
      eigenvalue.push_back(std::pow(10.0, rng.uniform(-1.5, 1.5)));
      angle.push_back(rng.uniform(0.0, 3.0));
    }
  }
  double operator()(std::span<const double> x, std::span<double> g) const {
    const std::size_t n = x.size();
    std::vector<double> r(n);
    for (std::size_t i = 0; i < n; ++i) r[i] = x[i] - center[i];
    const auto turn = [&](std::size_t i, double sign) {
      const double c = std::cos(angle[i]), s = sign * std::sin(angle[i]), a = r[i], b = r[i + 1];
      r[i] = c * a - s * b, r[i + 1] = s * a + c * b;
    };
    for (std::size_t i = 0; i + 1 < n; ++i) turn(i, 1.0);
    double f = 0.0;
    for (std::size_t i = 0; i < n; ++i) f += 0.5 * eigenvalue[i] * r[i] * r[i], r[i] *= eigenvalue[i];
    for (std::size_t i = n - 1; i-- > 0;) turn(i, -1.0);
    std::copy(r.begin(), r.end(), g.begin());
    return f;
  }
};

LbfgsOptions tight() {
  LbfgsOptions options;
  options.decrease_tolerance = 0.0;
  options.gradient_tolerance = 1e-9;
  options.max_evaluations = 5000;
  return options;
}

TEST(Lbfgs, FindsTheMinimumOfRandomQuadraticsWithAndWithoutGroups) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const int n = 3 + static_cast<int>(seed);
    const Quadratic quadratic(seed, n);
    for (const auto& blocks : {std::vector<int>{}, std::vector<int>{0, n / 2}}) {
      std::vector<double> x(static_cast<std::size_t>(n), 0.0);
      LbfgsOptions options = tight();
      options.blocks = blocks;
      const LbfgsSummary summary = minimize(quadratic, x, options);
      EXPECT_NE(summary.status, LbfgsStatus::not_run);
      for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_NEAR(x[i], quadratic.center[i], 1e-5) << "seed " << seed << ", " << name_of(summary.status);
    }
  }
}

TEST(Lbfgs, SolvesRosenbrockInTenDimensions) {
  const Objective rosenbrock = [](std::span<const double> x, std::span<double> g) {
    double f = 0.0;
    std::fill(g.begin(), g.end(), 0.0);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
      f += 100.0 * a * a + b * b;
      g[i] += -400.0 * a * x[i] - 2.0 * b;
      g[i + 1] += 200.0 * a;
    }
    return f;
  };
  std::vector<double> x(10, -1.2);
  minimize(rosenbrock, x, tight());
  for (const double v : x) EXPECT_NEAR(v, 1.0, 1e-5);
}

TEST(Lbfgs, ComesCloseToTheKinkOfANonSmoothFunction) {
  const Objective kinked = [](std::span<const double> x, std::span<double> g) {
    g[0] = (x[0] > 1.0 ? 3.0 : -3.0) + 0.2 * x[0];
    g[1] = (x[1] > x[0] ? 1.0 : -1.0);
    g[0] -= g[1];
    return 3.0 * std::abs(x[0] - 1.0) + 0.1 * x[0] * x[0] + std::abs(x[1] - x[0]);
  };
  std::vector<double> x{-4.0, 7.0};
  minimize(kinked, x, tight());
  EXPECT_NEAR(x[0], 1.0, 1e-3);
  EXPECT_NEAR(x[1], 1.0, 1e-3);
}

TEST(Lbfgs, KeepsItsEvaluationLimitAndRefusesANonFiniteStart) {
  const Quadratic quadratic(7, 30);
  std::vector<double> x(30, 5.0);
  LbfgsOptions options = tight();
  options.max_evaluations = 7;
  const LbfgsSummary summary = minimize(quadratic, x, options);
  EXPECT_LE(summary.evaluations, 7);
  EXPECT_LT(summary.cost, summary.initial_cost);
  std::vector<double> bad{std::nan("")};
  EXPECT_THROW(minimize([](auto v, auto g) { return g[0] = v[0]; }, bad, options), Error);
}

// An objective that becomes another one on the way, once to where the present point is worse than before: the
// minimum of the last one is found all the same.
TEST(Lbfgs, GoesOnWhenTheObjectiveChanges) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    constexpr int n = 8;
    const Quadratic first(seed, n), second(seed + 100, n);
    bool late = false;
    LbfgsOptions options = tight();
    options.changed = [&](int iteration) {
      if (iteration != 3) return false;
      late = true;
      return true;
    };
    std::vector<double> x(n, 0.0);
    minimize([&](std::span<const double> y,
                 std::span<double> g) { return late ? 1000.0 + second(y, g) : first(y, g); },
             x, options);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], second.center[i], 1e-5) << "seed " << seed;
  }
}

}  // namespace
}  // namespace seine::optim
