#include "seine/math/bernstein.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "seine/base/rng.hpp"

namespace seine::math {
namespace {

double horner(const std::vector<double>& c, double w) {
  double value = 0.0;
  for (auto it = c.rbegin(); it != c.rend(); ++it) value = value * w + *it;
  return value;
}

std::vector<double> random_coefficients(Rng& rng, int degree) {
  std::vector<double> c(static_cast<std::size_t>(degree) + 1);
  for (double& value : c) value = rng.normal();
  return c;
}

class Laws : public ::testing::TestWithParam<int> {};

TEST_P(Laws, ValueRoundTripAndBounds) {
  const int degree = GetParam();
  Rng rng(100 + static_cast<std::uint64_t>(degree));
  const auto c = random_coefficients(rng, degree);
  const Bernstein f = Bernstein::from_power(c);
  for (int i = 0; i < 50; ++i) {
    const double w = rng.uniform(), value = horner(c, w);
    EXPECT_NEAR(f(w), value, 1e-13 * (degree + 1));
    EXPECT_LE(f.lower_bound(), value + 1e-12);
    EXPECT_GE(f.upper_bound(), value - 1e-12);
  }
  std::vector<double> back(c.size());
  f.to_power(back);
  // Differences of order n lose about 2^n units in the last place.
  for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(back[k], c[k], 1e-14 * std::pow(3.0, degree));
}

TEST_P(Laws, RestrictionAndSplitKeepValues) {
  const int degree = GetParam();
  Rng rng(200 + static_cast<std::uint64_t>(degree));
  const Bernstein f = Bernstein::from_power(random_coefficients(rng, degree));
  for (int i = 0; i < 50; ++i) {
    double low = rng.uniform(), high = rng.uniform();
    if (low > high) std::swap(low, high);
    const Bernstein part = f.restricted(low, high);
    const auto [left, right] = f.split(low);
    const double w = rng.uniform();
    EXPECT_NEAR(part(w), f(low + w * (high - low)), 1e-12);
    EXPECT_NEAR(left(w), f(w * low), 1e-12);
    EXPECT_NEAR(right(w), f(low + w * (1.0 - low)), 1e-12);
    EXPECT_GE(part.lower_bound(), f.lower_bound() - 1e-12);
    EXPECT_LE(part.upper_bound(), f.upper_bound() + 1e-12);
  }
}

TEST_P(Laws, Arithmetic) {
  const int degree = GetParam();
  Rng rng(300 + static_cast<std::uint64_t>(degree));
  const auto c = random_coefficients(rng, degree), d = random_coefficients(rng, degree / 2);
  const Bernstein f = Bernstein::from_power(c), g = Bernstein::from_power(d);
  for (int i = 0; i < 20; ++i) {
    const double w = rng.uniform(), step = 1e-6;
    if (f.degree() + g.degree() <= Bernstein::kMaxDegree) {
      EXPECT_NEAR((f * g)(w), f(w) * g(w), 1e-11);
    }
    EXPECT_NEAR((f + g)(w), f(w) + g(w), 1e-12);
    EXPECT_NEAR((f - g)(w), f(w) - g(w), 1e-12);
    EXPECT_NEAR(f.elevated(Bernstein::kMaxDegree)(w), f(w), 1e-11);
    EXPECT_NEAR(f.derivative()(w), (f(w + step) - f(w - step)) / (2.0 * step),
                1e-5 * (degree + 1) * (degree + 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Laws, ::testing::Values(0, 1, 2, 4, 5, 8, 12, 20, 24, 30));

TEST(Bernstein, SplittingTightensQuadratically) {
  const std::vector<double> c{0.0, 4.0, -4.0};  // 4w(1 − w), largest value 1
  Bernstein f = Bernstein::from_power(c);
  EXPECT_DOUBLE_EQ(f.upper_bound(), 2.0);
  EXPECT_NEAR(f.split().first.upper_bound(), 1.0, 1e-15);
}

}  // namespace
}  // namespace seine::math
