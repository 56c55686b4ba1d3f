#include "seine/optim/qp_scaling.hpp"

#include <algorithm>
#include <cmath>

namespace seine::optim {
namespace {

constexpr int kPasses = 10;
// Norms outside are treated as at the border: a tiny or empty row is not blown up.
constexpr double kLeast = 1e-4, kMost = 1e4;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double inverse_root(double norm) {
  return 1.0 / std::sqrt(norm < kLeast ? 1.0 : std::min(norm, kMost));
}

template <class Visit>
void each(const SparseMatrix& m, const Visit& visit) {
  for (int j = 0; j < m.cols; ++j)
    for (int k = m.begin[at(j)]; k < m.begin[at(j) + 1]; ++k) visit(m.row[at(k)], j, at(k));
}

double cost_scale(const QpProblem& scaled) {
  double sum = 0.0;
  // The mean column norm of P, from the triangle: each entry counts for its column alone, which is near
  // enough.
  for (int j = 0; j < scaled.P.cols; ++j) {
    double norm = 0.0;
    for (int k = scaled.P.begin[at(j)]; k < scaled.P.begin[at(j) + 1]; ++k)
      norm = std::max(norm, std::abs(scaled.P.value[at(k)]));
    sum += norm;
  }
  const double norm = std::max(sum / std::max(1, scaled.P.cols), largest(scaled.q));
  return 1.0 / (norm < kLeast ? 1.0 : std::min(norm, kMost));
}

}  // namespace

QpScaling::QpScaling(int variables, int rows) : d(at(variables), 1.0), e(at(rows), 1.0) {}

void QpScaling::apply(const QpProblem& problem, QpProblem& scaled) const {
  each(problem.P, [&](int i, int j, std::size_t k) {
    scaled.P.value[k] = c * d[at(i)] * problem.P.value[k] * d[at(j)];
  });
  each(problem.A,
       [&](int i, int j, std::size_t k) { scaled.A.value[k] = e[at(i)] * problem.A.value[k] * d[at(j)]; });
  for (std::size_t j = 0; j < d.size(); ++j) scaled.q[j] = c * d[j] * problem.q[j];
  for (std::size_t i = 0; i < e.size(); ++i)
    scaled.lower[i] = e[i] * problem.lower[i], scaled.upper[i] = e[i] * problem.upper[i];
}

void QpScaling::equilibrate(const QpProblem& problem, QpProblem& scaled) {
  std::fill(d.begin(), d.end(), 1.0);
  std::fill(e.begin(), e.end(), 1.0);
  c = 1.0;
  apply(problem, scaled);
  for (int pass = 0; pass < kPasses; ++pass) {
    // The bounds' and the cost's vectors hold the norms until they are scaled anew.
    std::vector<double>&column = scaled.q, &row = scaled.lower;
    std::fill(column.begin(), column.end(), 0.0);
    std::fill(row.begin(), row.end(), 0.0);
    each(scaled.P, [&](int i, int j, std::size_t k) {
      const double size = std::abs(scaled.P.value[k]);
      column[at(i)] = std::max(column[at(i)], size), column[at(j)] = std::max(column[at(j)], size);
    });
    each(scaled.A, [&](int i, int j, std::size_t k) {
      const double size = std::abs(scaled.A.value[k]);
      row[at(i)] = std::max(row[at(i)], size), column[at(j)] = std::max(column[at(j)], size);
    });
    for (std::size_t j = 0; j < d.size(); ++j) d[j] *= inverse_root(column[j]);
    for (std::size_t i = 0; i < e.size(); ++i) e[i] *= inverse_root(row[i]);
    apply(problem, scaled);
    c *= cost_scale(scaled);
    apply(problem, scaled);
  }
}

}  // namespace seine::optim
