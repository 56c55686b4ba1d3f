#pragma once

#include <vector>

#include "seine/optim/qp.hpp"

namespace seine::optim {

/// Equilibration of a quadratic programme: x = D x̂, rows of A times E, the cost times c. Then y = E ŷ / c.
struct QpScaling {
  std::vector<double> d, e;
  double c = 1.0;

  /// None.
  QpScaling(int variables, int rows);
  /// Chooses D, E and c so that rows and columns of [P Aᵀ; A 0], and the cost, come out near 1: Ruiz'
  /// iteration with cost scaling [Stellato20, Alg. 2]. `scaled` is used as workspace and left scaled.
  void equilibrate(const QpProblem& problem, QpProblem& scaled);
  /// Fills `scaled`, which has the same pattern, without allocating.
  void apply(const QpProblem& problem, QpProblem& scaled) const;
};

}  // namespace seine::optim
