#pragma once

#include <functional>
#include <span>
#include <vector>

namespace seine::optim {

/// f(x), and its gradient into `gradient` (same size as x).
using Objective = std::function<double(std::span<const double> x, std::span<double> gradient)>;

struct LbfgsOptions {
  int memory = 16;  ///< pairs kept; 16-32 beats more for our problems (docs/optimiser.md)
  int max_evaluations = 1000;
  double gradient_tolerance = 1e-8;  ///< stop when ‖g‖∞ ≤ this · max(1, ‖x‖∞)
  /// Stop when f fell by less than this, relative to |f|, over the last `past` iterations.
  double decrease_tolerance = 1e-4;
  int past = 3;
  double sufficient_decrease = 1e-4;  ///< c1 of the weak Wolfe conditions
  double curvature = 0.9;             ///< c2
  double max_step = 1e10;             ///< longest ‖step‖∞ of one iteration
  /// Where independent groups of variables begin (ascending, first 0); empty: one group. Each group keeps its
  /// own inverse Hessian, so weakly coupled groups converge as fast as each would alone. All share one step
  /// length.
  std::vector<int> blocks;
  /// Called after every iteration; true when f has become another function.
  std::function<bool(int iteration)> changed;
  /// Called after every iteration; stops when it returns true.
  std::function<bool(int iteration, double cost)> stop;
};

enum class LbfgsStatus { not_run, converged, small_gradient, evaluation_limit, stopped, no_step };
const char* name_of(LbfgsStatus status);

struct LbfgsSummary {
  LbfgsStatus status = LbfgsStatus::not_run;
  int iterations = 0;
  int evaluations = 0;
  double initial_cost = 0.0;
  double cost = 0.0;
};

/// Minimises a smooth (or mildly kinked) function from `x`, in place: limited-memory BFGS [Liu89] with the
/// bisection line search for weak Wolfe conditions, which also copes with kinks [Lewis13]. `x` ends at the
/// best point visited. Throws Error when f(x) is not finite at the start.
LbfgsSummary minimize(const Objective& objective, std::span<double> x, const LbfgsOptions& options = {});

}  // namespace seine::optim
