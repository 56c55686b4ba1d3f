#pragma once

#include <span>
#include <vector>

#include "seine/optim/qp.hpp"

namespace seine::optim {

/// The residuals of a point beside the size of the terms they are made of, which a relative tolerance refers
/// to.
struct QpMeasure {
  double primal, primal_terms;  ///< violation of the bounds; ‖A x‖∞ and the bounds violated
  double dual, dual_terms;      ///< ‖P x + q + Aᵀy‖∞; the largest of the three
  double gap, gap_terms;

  /// Largest ratio of a residual to its tolerance: ≤ 1 is good enough.
  double ratio(double absolute, double relative) const;
};

/// Like kkt_residuals(), without allocating.
class QpMeter {
 public:
  QpMeter(int variables, int rows);
  QpMeasure measure(const QpProblem& problem, std::span<const double> x, std::span<const double> y);

 private:
  std::vector<double> ax_, px_, aty_;
};

}  // namespace seine::optim
