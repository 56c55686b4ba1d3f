#include "seine/mpc/model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"

namespace seine::mpc {
namespace {

constexpr std::uint64_t kSeed = 20291;
constexpr double kWheelbase = 0.4;

State random_state(Rng& rng) {
  return {rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-3, 3), rng.uniform(-3, 3)};
}
Input random_input(Rng& rng) {
  return {rng.uniform(-3, 3), rng.uniform(-0.7, 0.7)};
}

// The differential equation itself, fourth order.
State runge_kutta(State s, const Input& u, double dt, int steps) {
  const auto rate = [&](const State& x) {
    return State{x.speed * std::cos(x.heading), x.speed * std::sin(x.heading),
                 x.speed * std::tan(u.steering) / kWheelbase, u.acceleration};
  };
  const auto plus = [](const State& a, double h, const State& b) {
    return State{a.x + h * b.x, a.y + h * b.y, a.heading + h * b.heading, a.speed + h * b.speed};
  };
  const double h = dt / steps;
  for (int i = 0; i < steps; ++i) {
    const State a = rate(s), b = rate(plus(s, h / 2, a)), c = rate(plus(s, h / 2, b)),
                d = rate(plus(s, h, c));
    s = plus(plus(plus(plus(s, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  return s;
}

TEST(Model, TheExactStepSolvesTheDifferentialEquation) {
  Rng rng(kSeed);
  for (int i = 0; i < 500; ++i) {
    const State s = random_state(rng);
    const Input u = i % 5 == 0 ? Input{rng.uniform(-3, 3), 0.0} : random_input(rng);
    const double dt = rng.uniform(0.01, 0.5);
    const State exact = advance(s, u, kWheelbase, dt), fine = runge_kutta(s, u, dt, 200);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(vector_of(exact)[k], vector_of(fine)[k], 1e-9) << "seed " << kSeed << ", case " << i;
  }
}

TEST(Model, StepsJoin) {
  Rng rng(kSeed + 1);
  for (int i = 0; i < 200; ++i) {
    const State s = random_state(rng);
    const Input u = random_input(rng);
    const State once = advance(s, u, kWheelbase, 0.3),
                twice = advance(advance(s, u, kWheelbase, 0.1), u, kWheelbase, 0.2);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(vector_of(once)[k], vector_of(twice)[k], 1e-12);
  }
}

TEST(Model, TheEulerStepIsTheSupplements) {
  const State s{1.0, 2.0, 0.5, -1.2};
  const Input u{0.7, 0.3};
  const State next = advance(s, u, kWheelbase, 0.05, Discretisation::euler);
  EXPECT_DOUBLE_EQ(next.x, 1.0 - 1.2 * std::cos(0.5) * 0.05);
  EXPECT_DOUBLE_EQ(next.y, 2.0 - 1.2 * std::sin(0.5) * 0.05);
  EXPECT_DOUBLE_EQ(next.heading, 0.5 - 1.2 * std::tan(0.3) / kWheelbase * 0.05);
  EXPECT_DOUBLE_EQ(next.speed, -1.2 + 0.7 * 0.05);
}

TEST(Model, DerivativesAgreeWithCentralDifferences) {
  Rng rng(kSeed + 2);
  double worst = 0.0;
  for (const Discretisation d : {Discretisation::euler, Discretisation::exact})
    for (int i = 0; i < 300; ++i) {
      State s = random_state(rng);
      Input u = random_input(rng);
      // Rest and straight ahead are where formulas of arcs fail.
      if (i % 4 == 1) s.speed = 0.0;
      if (i % 4 == 2) u.steering = 1e-7 * rng.normal();
      if (i % 4 == 3) s.speed = u.acceleration = 0.0;
      const double dt = 0.05;
      const LinearModel m = linearise(s, u, kWheelbase, dt, d);
      const auto check = [&](double& entry, auto&& column) {
        constexpr double kStep = 1e-6;
        const double kept = entry;
        entry = kept + kStep;
        const StateVector up = vector_of(advance(s, u, kWheelbase, dt, d));
        entry = kept - kStep;
        const StateVector down = vector_of(advance(s, u, kWheelbase, dt, d));
        entry = kept;
        for (std::size_t k = 0; k < 4; ++k)
          worst = std::max(worst, std::abs((up[k] - down[k]) / (2 * kStep) - column(k)));
      };
      double* const state[] = {&s.x, &s.y, &s.heading, &s.speed};
      for (std::size_t j = 0; j < 4; ++j) check(*state[j], [&](std::size_t k) { return m.A[k][j]; });
      double* const input[] = {&u.acceleration, &u.steering};
      for (std::size_t j = 0; j < 2; ++j) check(*input[j], [&](std::size_t k) { return m.B[k][j]; });
    }
  EXPECT_LT(worst, 1e-8) << "seed " << kSeed + 2;
}

}  // namespace
}  // namespace seine::mpc
