#pragma once

#include <array>
#include <string>
#include <vector>

namespace seine::baseline::letter {

/// The limits 𝒢_d that become penalties.
enum class Limit { speed, tangential, lateral, curvature, corridor, robots, net_size, net_topology };
inline constexpr std::size_t kLimits = 8;

/// What the letter's method leaves open. SI units; docs/letter.md has one table with a reason for each value.
struct Settings {
  // Given by the letter, its supplement or the literature around it.
  double cusp_speed = 0.24;  ///< m/s, |v| at starts, stops and gear changes; the literature has 0.05 and 0.1
  double knee = 1e-4;        ///< a₀ of L1
  int intervals = 16;        ///< of the quadrature, a piece …
  int end_intervals = 32;    ///< … and for the first and last piece of a segment

  // Chosen.
  double jerk_weight = 1.0;   ///< W = this times the unit matrix
  double time_weight = 30.0;  ///< w_T
  /// w_d in the order of Limit.
  std::array<double, kLimits> weight{1e3, 1e3, 1e3, 2e3, 3e4, 3e4, 1e4, 1e4};
  double smoothing = 200.0;       ///< α of log-sum-exp, 1/m
  double clamp = 0.05;            ///< ε of the clamp of an edge's parameter
  double blend = 0.05;            ///< e of the catch cost, m
  double centring = 500.0;        ///< w_ce, 1/m
  double catching = 1000.0;       ///< w_ca, 1/m
  double topology_margin = 0.05;  ///< m inside the line through a ring edge
  double end_weight = 1e4;        ///< of ends outside the delivery region
  double slack =
      0.01;  ///< m added to every clearance, so that what lies between samples stays outside the margin
  double piece_length = 1.2;                           ///< car lengths of the guess in one piece
  double speed_share = 0.8, acceleration_share = 0.6;  ///< of the limits that the guess's timing uses
  double corridor_reach = 3.0;                         ///< car lengths from the guess

  // The solver.
  int memory = 32;
  double decrease = 1e-4;  ///< relative decrease of the cost that ends it …
  int past = 5;            ///< … over this many iterations
  int evaluations = 4000;  ///< at most

  // When the method calls itself successful: the solver stopped by itself, and no sample is off by more than
  double claim_relative = 0.02;  ///< of a limit on speed, acceleration or curvature
  double claim_distance = 0.01;  ///< m

  /// Every complaint at once; empty when all is well.
  std::vector<std::string> complaints() const;
};

}  // namespace seine::baseline::letter
