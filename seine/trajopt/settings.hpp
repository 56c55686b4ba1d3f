#pragma once

namespace seine::trajopt {

/// Weights and tolerances of the joint problem. Dimensionless: the problem is solved in units of the cars'
/// length and the time it takes to drive it at top speed, so one set serves model cars and real ones
/// (docs/optimiser.md has the measurements behind each value).
struct Settings {
  /// Price of smoothness against time: of ∫ (j t_a / a_max)² dt / t_a with t_a = v_max / a_max, relative to
  /// the price of one unit of time.
  double jerk = 0.0024;
  double curve_smoothness = 0.02;  ///< of ∫ |p'''|² du / l²
  double regularity = 0.1;         ///< of the mean of (|p'|²/l² − 1)²
  /// Penalty on the mean violation of each kind, per unit of guessed travel time: it must exceed the
  /// multipliers, which scale like it.
  double penalty = 60.0;
  /// Factors on the penalty for the corridor, and for distances to other cars and moving obstacles: contacts
  /// are short, so their whole multiplier rests on a few samples.
  double corridor_penalty = 4.0, pair_penalty = 3.0;
  /// The same for what a net asks all the time, and at single moments (catch and delivery).
  double net_penalty = 3.0, catch_penalty = 2.0;
  double soft_knee = 0.1, stiff_knee = 0.03;            ///< of the hinge, first and second stage
  double soft_decrease = 1e-3, stiff_decrease = 3e-4;   ///< relative decrease that ends a stage …
  int past = 4;                                         ///< … over this many iterations
  int soft_evaluations = 300, stiff_evaluations = 700;  ///< at most
  int memory = 16;
  /// Of the logarithms of durations as the optimiser sees them, for clocks on which single moments matter.
  double duration_scale = 1.0;
  double tighten =
      0.01;  ///< limits are kept to (1 − this), so that what happens between samples stays inside
  double clearance_slack = 0.015;  ///< car lengths added to every clearance, for the same reason
};

}  // namespace seine::trajopt
