#include "seine/mpc/model.hpp"

#include <cmath>

namespace seine::mpc {
namespace {

// The chord of an arc of unit length that turns by `turn`: (sin t / t, (1 − cos t) / t), and d/dt of both.
struct Chord {
  double along, across, d_along, d_across;
};

Chord chord_of(double turn) {
  const double t2 = turn * turn;
  // Where the quotients lose digits their series serve: the next terms are below 1e-17.
  if (std::abs(turn) < 1e-2)
    return {1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0)),
            turn / 2.0 * (1.0 - t2 / 12.0 * (1.0 - t2 / 30.0 * (1.0 - t2 / 56.0))),
            -turn / 3.0 * (1.0 - t2 / 10.0 * (1.0 - t2 / 28.0)),
            0.5 - t2 / 8.0 * (1.0 - t2 / 18.0 * (1.0 - t2 / 40.0))};
  const double s = std::sin(turn), c = std::cos(turn);
  return {s / turn, (1.0 - c) / turn, (c - s / turn) / turn, (s - (1.0 - c) / turn) / turn};
}

// Everything in the axes of the heading at the begin; `linearise` turns it.
LinearModel exact_step(const State& state, const Input& input, double wheelbase, double dt) {
  const double tangent = std::tan(input.steering), curvature = tangent / wheelbase;
  const double length = dt * (state.speed + 0.5 * input.acceleration * dt), turn = curvature * length;
  const Chord chord = chord_of(turn);
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  const auto turned = [&](double along, double across) {
    return std::array<double, 2>{c * along - s * across, s * along + c * across};
  };
  const auto moved = turned(length * chord.along, length * chord.across);
  const auto by_heading = turned(-length * chord.across, length * chord.along);
  // By the length of the arc at constant curvature, and by the curvature at constant length.
  const auto by_length = turned(chord.along + turn * chord.d_along, chord.across + turn * chord.d_across);
  const auto by_curvature = turned(length * length * chord.d_along, length * length * chord.d_across);
  const double by_steering = (1.0 + tangent * tangent) / wheelbase, half = 0.5 * dt * dt;

  LinearModel m;
  m.next = {state.x + moved[0], state.y + moved[1], state.heading + turn,
            state.speed + input.acceleration * dt};
  m.A = {{{1.0, 0.0, by_heading[0], dt * by_length[0]},
          {0.0, 1.0, by_heading[1], dt * by_length[1]},
          {0.0, 0.0, 1.0, dt * curvature},
          {0.0, 0.0, 0.0, 1.0}}};
  m.B = {{{half * by_length[0], by_steering * by_curvature[0]},
          {half * by_length[1], by_steering * by_curvature[1]},
          {half * curvature, by_steering * length},
          {dt, 0.0}}};
  return m;
}

// The supplement's equations: x_{k+1} = x + v cos θ Δt and so on, linear in θ, v and ω = v tan φ / L.
LinearModel euler_step(const State& state, const Input& input, double wheelbase, double dt) {
  const double c = std::cos(state.heading), s = std::sin(state.heading), v = state.speed;
  const double tangent = std::tan(input.steering), curvature = tangent / wheelbase;
  LinearModel m;
  m.next = {state.x + v * c * dt, state.y + v * s * dt, state.heading + v * curvature * dt,
            v + input.acceleration * dt};
  m.A = {{{1.0, 0.0, -v * s * dt, c * dt},
          {0.0, 1.0, v * c * dt, s * dt},
          {0.0, 0.0, 1.0, curvature * dt},
          {0.0, 0.0, 0.0, 1.0}}};
  m.B = {{{0.0, 0.0}, {0.0, 0.0}, {0.0, v * (1.0 + tangent * tangent) / wheelbase * dt}, {dt, 0.0}}};
  return m;
}

}  // namespace

LinearModel linearise(const State& state, const Input& input, double wheelbase, double dt,
                      Discretisation discretisation) {
  return discretisation == Discretisation::exact ? exact_step(state, input, wheelbase, dt)
                                                 : euler_step(state, input, wheelbase, dt);
}

State advance(const State& state, const Input& input, double wheelbase, double dt,
              Discretisation discretisation) {
  return linearise(state, input, wheelbase, dt, discretisation).next;
}

}  // namespace seine::mpc
