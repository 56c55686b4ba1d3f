#include "seine/optim/qp_measure.hpp"

#include <algorithm>
#include <cmath>

namespace seine::optim {

double QpMeasure::ratio(double absolute, double relative) const {
  const double worst =
      std::max({primal / (absolute + relative * primal_terms), dual / (absolute + relative * dual_terms),
                gap / (absolute + relative * gap_terms)});
  // Comparisons lose what is not a number.
  return std::isfinite(primal + dual + gap) ? worst : HUGE_VAL;
}

QpMeter::QpMeter(int variables, int rows)
    : ax_(static_cast<std::size_t>(rows)),
      px_(static_cast<std::size_t>(variables)),
      aty_(static_cast<std::size_t>(variables)) {}

QpMeasure QpMeter::measure(const QpProblem& problem, std::span<const double> x, std::span<const double> y) {
  multiply(problem.A, x, ax_);
  multiply_symmetric(problem.P, x, px_);
  multiply_transposed(problem.A, y, aty_);
  QpMeasure m{};
  m.primal_terms = largest(ax_);
  m.dual_terms = std::max({largest(px_), largest(aty_), largest(problem.q)});
  double support = 0.0, pull = 0.0;  // pull: the largest multiplier where there is no bound
  for (std::size_t i = 0; i < ax_.size(); ++i) {
    m.primal = std::max({m.primal, problem.lower[i] - ax_[i], ax_[i] - problem.upper[i]});
    const double bound = y[i] > 0.0 ? problem.upper[i] : problem.lower[i];
    if (std::abs(bound) >= kNoBound)
      pull = std::max(pull, std::abs(y[i]));
    else
      support += y[i] * bound;
  }
  const double xpx = dot(x, px_), qx = dot(problem.q, x);
  m.gap = std::abs(xpx + qx + support);
  m.gap_terms = std::max({std::abs(xpx), std::abs(qx), std::abs(support)});
  for (std::size_t j = 0; j < px_.size(); ++j) px_[j] += problem.q[j] + aty_[j];
  m.dual = std::max(largest(px_), pull);
  if (!std::isfinite(m.primal_terms)) m.primal = HUGE_VAL;
  return m;
}

}  // namespace seine::optim
