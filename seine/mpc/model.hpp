#pragma once

#include <array>

#include "seine/vehicle/model.hpp"

namespace seine::mpc {

/// X = (x, y, θ, v): rear-axle middle and heading in the world, signed speed. SI units.
struct State {
  double x = 0.0, y = 0.0, heading = 0.0, speed = 0.0;
};

/// U = (a, φ): acceleration along the body's x axis, angle of the front wheel.
struct Input {
  double acceleration = 0.0, steering = 0.0;
};

using StateVector = std::array<double, 4>;  ///< in the order of State
using InputVector = std::array<double, 2>;
inline StateVector vector_of(const State& s) {
  return {s.x, s.y, s.heading, s.speed};
}
inline InputVector vector_of(const Input& u) {
  return {u.acceleration, u.steering};
}

/// X_{k+1} ≈ next + A (X_k − X̂) + B (U_k − Û).
struct LinearModel {
  State next;  ///< f(X̂, Û); its heading is not wrapped
  std::array<StateVector, 4> A;
  std::array<InputVector, 4> B;
};

/// How one step of the bicycle is taken.
enum class Discretisation {
  euler,  ///< as in the supplement: X + Ẋ Δt
  exact,  ///< the arc that a constant input drives
};

/// The bicycle ẋ = v cos θ, ẏ = v sin θ, θ̇ = v tan φ / L, v̇ = a over `dt` seconds with the input held.
State advance(const State& state, const Input& input, double wheelbase, double dt,
              Discretisation discretisation = Discretisation::exact);
/// The same with its derivatives.
LinearModel linearise(const State& state, const Input& input, double wheelbase, double dt,
                      Discretisation discretisation);

}  // namespace seine::mpc
