#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "seine/optim/qp_sparse.hpp"

namespace seine::optim {

/// min ½ xᵀP x + qᵀx  subject to  lower ≤ A x ≤ upper, P positive semidefinite. Equal bounds make an
/// equation, infinite ones none; bounds on variables are rows of A. Multipliers y: P x + q + Aᵀy = 0, y ≥ 0
/// at an upper bound, ≤ 0 at a lower one.
struct QpProblem {
  SparseMatrix P;  ///< upper triangle, with or without all of the diagonal
  std::vector<double> q;
  SparseMatrix A;
  std::vector<double> lower, upper;

  int variables() const { return static_cast<int>(q.size()); }
  int rows() const { return static_cast<int>(lower.size()); }
  /// Every complaint, one a line; empty when all is well. Convexity is the solver's to find out.
  std::string complaints() const;
};

/// Bounds from here on count as infinite: some write 1e20 for none.
constexpr double kNoBound = 1e19;

/// How far (x, y) is from satisfying the conditions of optimality: recomputed from the problem as it was
/// given, so that no solver is judge of itself.
struct KktResiduals {
  double primal = 0.0;  ///< largest violation of a bound
  double dual = 0.0;    ///< ‖P x + q + Aᵀy‖∞, or a multiplier where there is no bound
  double gap = 0.0;     ///< |xᵀP x + qᵀx + Σ_i (y_i⁺ upper_i − y_i⁻ lower_i)|
  double objective = 0.0;
};
KktResiduals kkt_residuals(const QpProblem& problem, std::span<const double> x, std::span<const double> y);

enum class QpBackend { own, osqp };
/// Whether the library behind a backend was there when Seine was built.
bool available(QpBackend backend);

struct QpOptions {
  QpBackend backend = QpBackend::own;
  double absolute = 1e-6, relative = 1e-6;  ///< tolerance of each residual: absolute + relative · its terms
  double infeasible = 1e-7;                 ///< tolerance of the certificates of infeasibility
  int max_iterations = 20000;
  int interior_after = 1000;  ///< iterations after which the interior point method is tried, once
  int check_every = 10;       ///< iterations between two looks at the residuals
  bool equilibrate = true;    ///< Ruiz scaling of rows and columns
  bool keep_scaling = false;  ///< an update keeps the scaling of the set-up: cheaper, for problems alike
  double rho = 0.1;           ///< penalty to start with
  bool adaptive_rho = true;
  double sigma = 1e-6;      ///< of the regularisation in x
  double relaxation = 1.6;  ///< α in (0, 2)
  bool polish = true;       ///< solve for the guessed active set, which takes the accuracy to rounding
  double polished = 1e-9;   ///< residual (relative like above) at which a polished point ends the search
};

enum class QpStatus {
  not_run,
  solved,
  iteration_limit,
  primal_infeasible,  ///< y holds the certificate
  dual_infeasible,    ///< unbounded below; x holds the direction
  not_convex,         ///< the factorisation found a negative direction of P
};
const char* name_of(QpStatus status);

struct QpSummary {
  QpStatus status = QpStatus::not_run;
  int iterations = 0;
  int factorisations = 0;
  bool polished = false;
  double rho = 0.0;  ///< at the end; a later solve goes on with it
};

/// A solver that was set up for one problem. What follows — new numbers in the same pattern, another start,
/// another solve — allocates nothing.
class QpSolver {
 public:
  virtual ~QpSolver() = default;
  /// Takes over all numbers. The patterns of P and A must be those of the set-up: InputError otherwise.
  virtual void update(const QpProblem& problem) = 0;
  /// Where the next solve begins; without it, where the last one ended (at first: 0).
  virtual void warm_start(std::span<const double> x, std::span<const double> y) = 0;
  virtual QpSummary solve() = 0;
  virtual std::span<const double> x() const = 0;
  virtual std::span<const double> y() const = 0;
};

/// Throws InputError for a problem with complaints, or a backend that is not available.
std::unique_ptr<QpSolver> make_qp_solver(const QpProblem& problem, const QpOptions& options = {});

}  // namespace seine::optim
