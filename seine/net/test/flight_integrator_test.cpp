// Flights with drag against an adaptive integrator of another order and another formula: Dormand and Prince's
// pair 5(4) in long double, with its own step control.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/flight.hpp"

namespace seine::net {
namespace {

using Real = long double;
using State = std::array<Real, 6>;  // position, velocity

constexpr std::uint64_t kSeed = 57;

State rate(const State& s, Real drag) {
  const Real speed = std::sqrt(s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
  return {s[3], s[4], s[5], -drag * speed * s[3], -drag * speed * s[4], -9.80665L - drag * speed * s[5]};
}

/// One step; returns the estimate of its error.
Real step(State& s, Real h, Real drag) {
  static constexpr Real a[7][6] = {
      {},
      {1.0L / 5},
      {3.0L / 40, 9.0L / 40},
      {44.0L / 45, -56.0L / 15, 32.0L / 9},
      {19372.0L / 6561, -25360.0L / 2187, 64448.0L / 6561, -212.0L / 729},
      {9017.0L / 3168, -355.0L / 33, 46732.0L / 5247, 49.0L / 176, -5103.0L / 18656},
      {35.0L / 384, 0, 500.0L / 1113, 125.0L / 192, -2187.0L / 6784, 11.0L / 84}};
  static constexpr Real fourth[7] = {
      5179.0L / 57600, 0, 7571.0L / 16695, 393.0L / 640, -92097.0L / 339200, 187.0L / 2100, 1.0L / 40};
  std::array<State, 7> k;
  State last = s;
  for (std::size_t i = 0; i < 7; ++i) {
    last = s;
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t c = 0; c < 6; ++c) last[c] += h * a[i][j] * k[j][c];
    k[i] = rate(last, drag);
  }
  Real error = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    Real other = s[c];
    for (std::size_t i = 0; i < 7; ++i) other += h * fourth[i] * k[i][c];
    error = std::max(error, std::abs(other - last[c]));
  }
  s = last;
  return error;
}

State integrate(State s, Real duration, Real drag) {
  constexpr Real kError = 1e-13L;
  Real t = 0, h = 1e-3L;
  while (t < duration) {
    h = std::min(h, duration - t);
    State next = s;
    const Real error = step(next, h, drag);
    if (error <= kError) s = next, t += h;
    h *= std::clamp(0.9L * std::pow(kError / std::max(error, 1e-30L), 0.2L), 0.2L, 3.0L);
  }
  return s;
}

TEST(Flight, AgreesWithAnAdaptiveIntegrator) {
  Rng rng(kSeed);
  const int flights = effort(400, 40);
  for (int i = 0; i < flights; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", flight " + std::to_string(i));
    Target target;
    target.time = rng.uniform(-1.0, 2.0);
    target.position = {rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(1.2, 4.0)};
    target.velocity = {rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-2, 12)};
    target.drag = i % 8 == 0 ? 0.0 : std::pow(10.0, rng.uniform(-3.0, 2.0));
    const State first{target.position.x, target.position.y, target.position.z,
                      target.velocity.x, target.velocity.y, target.velocity.z};
    const Flight flight(target);
    const double rim = rng.uniform(0.3, 1.1);
    const auto crossing = flight.crossing(rim);
    ASSERT_TRUE(crossing);
    const double times[] = {rng.uniform(0.0, 1.0) * (crossing->state.time - target.time),
                            crossing->state.time - target.time};
    for (const double after : times) {
      const State there = integrate(first, static_cast<Real>(after), static_cast<Real>(target.drag));
      const FlightState found = flight.at(target.time + after);
      EXPECT_NEAR(found.position.x, static_cast<double>(there[0]), 2e-6);
      EXPECT_NEAR(found.position.y, static_cast<double>(there[1]), 2e-6);
      EXPECT_NEAR(found.position.z, static_cast<double>(there[2]), 2e-6);
      EXPECT_NEAR(found.velocity.x, static_cast<double>(there[3]), 1e-4);
      EXPECT_NEAR(found.velocity.y, static_cast<double>(there[4]), 1e-4);
      EXPECT_NEAR(found.velocity.z, static_cast<double>(there[5]), 1e-4);
    }
    EXPECT_NEAR(flight.at(crossing->state.time).position.z, rim, 2e-6);
    EXPECT_LT(crossing->state.velocity.z, 0.0);
  }
}

}  // namespace
}  // namespace seine::net
