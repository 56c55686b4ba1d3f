#include "seine/optim/qp.hpp"

#include <algorithm>
#include <cmath>

#include "seine/base/error.hpp"
#include "seine/optim/qp_osqp.hpp"
#include "seine/optim/qp_splitting.hpp"

namespace seine::optim {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

bool well_formed(const SparseMatrix& m) {
  if (m.rows < 0 || m.cols < 0 || m.begin.size() != at(m.cols) + 1 || m.value.size() != m.row.size())
    return false;
  if (m.begin.front() != 0 || m.begin.back() != m.entries()) return false;
  for (int j = 0; j < m.cols; ++j) {
    if (m.begin[at(j)] > m.begin[at(j) + 1]) return false;
    for (int k = m.begin[at(j)]; k < m.begin[at(j) + 1]; ++k) {
      const int row = m.row[at(k)];
      if (row < 0 || row >= m.rows || (k > m.begin[at(j)] && row <= m.row[at(k) - 1])) return false;
    }
  }
  return true;
}

bool is_upper(const SparseMatrix& m) {
  for (int j = 0; j < m.cols; ++j)
    for (int k = m.begin[at(j)]; k < m.begin[at(j) + 1]; ++k)
      if (m.row[at(k)] > j) return false;
  return true;
}

bool finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::string QpProblem::complaints() const {
  std::string all;
  const auto complain = [&](const std::string& text) { all += (all.empty() ? "" : "\n") + text; };
  const int n = variables(), m = rows();
  if (!well_formed(P) || !well_formed(A)) return "a matrix is not in compressed columns with ascending rows";
  if (P.rows != n || P.cols != n)
    complain("P must be " + std::to_string(n) + " x " + std::to_string(n) + " like q");
  if (A.rows != m || A.cols != n) complain("A must be " + std::to_string(m) + " x " + std::to_string(n));
  if (upper.size() != lower.size()) complain("lower and upper differ in size");
  if (!is_upper(P)) complain("P has entries below the diagonal; only its upper triangle is wanted");
  if (!finite(P.value) || !finite(A.value) || !finite(q)) complain("P, A or q is not finite");
  for (std::size_t i = 0; i < std::min(lower.size(), upper.size()); ++i)
    if (!(lower[i] <= upper[i]) || lower[i] == HUGE_VAL || upper[i] == -HUGE_VAL)
      complain("row " + std::to_string(i) + ": no number lies between its bounds");
  return all;
}

KktResiduals kkt_residuals(const QpProblem& problem, std::span<const double> x, std::span<const double> y) {
  std::vector<double> ax(problem.lower.size()), px(problem.q.size()), aty(problem.q.size());
  multiply(problem.A, x, ax);
  multiply_symmetric(problem.P, x, px);
  multiply_transposed(problem.A, y, aty);
  KktResiduals r;
  double support = 0.0, pull = 0.0;  // pull: the largest multiplier where there is no bound
  for (std::size_t i = 0; i < ax.size(); ++i) {
    r.primal = std::max({r.primal, problem.lower[i] - ax[i], ax[i] - problem.upper[i]});
    const double bound = y[i] > 0.0 ? problem.upper[i] : problem.lower[i];
    if (std::abs(bound) >= kNoBound)
      pull = std::max(pull, std::abs(y[i]));
    else
      support += y[i] * bound;
  }
  for (std::size_t j = 0; j < px.size(); ++j) aty[j] += px[j] + problem.q[j];
  r.dual = std::max(largest(aty), pull);
  const double xpx = dot(x, px), qx = dot(problem.q, x);
  r.gap = std::abs(xpx + qx + support);
  r.objective = 0.5 * xpx + qx;
  return r;
}

bool available(QpBackend backend) {
  return backend == QpBackend::own || osqp_is_there();
}

const char* name_of(QpStatus status) {
  switch (status) {
    case QpStatus::not_run:
      return "not run";
    case QpStatus::solved:
      return "solved";
    case QpStatus::iteration_limit:
      return "iteration limit";
    case QpStatus::primal_infeasible:
      return "primal infeasible";
    case QpStatus::dual_infeasible:
      return "dual infeasible";
    case QpStatus::not_convex:
      return "not convex";
  }
  return "?";
}

std::unique_ptr<QpSolver> make_qp_solver(const QpProblem& problem, const QpOptions& options) {
  const std::string complaints = problem.complaints();
  if (!complaints.empty())
    throw InputError("quadratic programme: " + complaints.substr(0, complaints.find('\n')));
  if (!available(options.backend)) throw InputError("quadratic programme: Seine was built without OSQP");
  if (options.backend == QpBackend::osqp) return make_osqp(problem, options);
  return make_splitting(problem, options);
}

}  // namespace seine::optim
