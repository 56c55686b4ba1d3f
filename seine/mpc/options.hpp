#pragma once

#include <string>
#include <vector>

#include "seine/mpc/model.hpp"
#include "seine/optim/qp.hpp"

namespace seine::mpc {

/// Weights of the supplement's cost
///   Σ_{k=1..K} ‖X_k − X_k^ref‖²_{Q_x} + Σ_{k=0..K−1} (‖U_k − U_k^ref‖²_{Q_u} + ‖U_k‖²_R) + Σ ‖U_k −
///   U_{k−1}‖²_{R_d}.
struct Weights {
  StateVector state{50.0, 50.0, 5.0, 2.0};  ///< Q_x of (x, y, θ, v): 1/m², 1/m², 1/rad², s²/m²
  InputVector input{0.1, 1.0};              ///< Q_u of (a, φ), from the reference
  InputVector effort{0.0, 0.0};             ///< R of (a, φ), from zero: pulls off the reference
  InputVector change{0.02, 2.0};            ///< R_d of (Δa, Δφ)
};

/// What the tracker looks at and may ask for, beyond the limits of the car's model.
struct Options {
  int horizon = 20;        ///< K
  double step = 0.05;      ///< Δt, s
  double period = 0.05;    ///< s between two commands, ≤ step
  double dead_time = 0.0;  ///< s from a command until it acts; the state is predicted over it
  double lag = 0.0;        ///< s, time constant with which the inputs follow the commands
  Weights weights;
  /// Δa_max, largest change of a in one step, as a share of the model's a_max: plans start and stop at up to
  /// a_max.
  double acceleration_change = 1.0;
  /// Δφ_max, largest change of φ in one step, rad; where the model limits the steering rate, that holds too.
  double steering_change = 0.35;
  /// m/s² per radian: where v²/L is more, steering costs more by the square of how much, as it does more.
  double authority = 15.7;
  Discretisation discretisation = Discretisation::exact;
  int reuse = 5;  ///< commands taken from the last good plan before the car is stopped
  optim::QpOptions qp{
      .absolute = 1e-5, .relative = 1e-5, .max_iterations = 500, .interior_after = 200, .keep_scaling = true};

  /// Every complaint; empty when all is well.
  std::vector<std::string> validate() const;
};

}  // namespace seine::mpc
