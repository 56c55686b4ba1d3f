#include "seine/optim/qp_osqp.hpp"

#include "seine/base/error.hpp"

#ifdef SEINE_OSQP
#include <osqp.h>

#include <algorithm>
#include <utility>

namespace seine::optim {
namespace {

struct Cleanup {
  void operator()(OSQPSolver* solver) const { osqp_cleanup(solver); }
};

// The arrays behind one of the library's matrices, in its own integer type.
struct Columns {
  std::vector<OSQPInt> begin, row;
  std::vector<OSQPFloat> value;
  OSQPCscMatrix view;

  explicit Columns(const SparseMatrix& m)
      : begin(m.begin.begin(), m.begin.end()), row(m.row.begin(), m.row.end()), value(m.value) {
    OSQPCscMatrix_set_data(&view, m.rows, m.cols, m.entries(), value.data(), row.data(), begin.data());
  }
};

OSQPSettings settings_for(const QpOptions& options) {
  OSQPSettings settings;
  osqp_set_default_settings(&settings);
  settings.verbose = 0;
  settings.eps_abs = options.absolute, settings.eps_rel = options.relative;
  settings.eps_prim_inf = settings.eps_dual_inf = options.infeasible;
  settings.max_iter = options.max_iterations, settings.check_termination = options.check_every;
  settings.scaling = options.equilibrate ? 10 : 0;
  settings.rho = options.rho, settings.sigma = options.sigma, settings.alpha = options.relaxation;
  settings.adaptive_rho = options.adaptive_rho;
  settings.adaptive_rho_interval = 50;  // not by the clock: results must not depend on it
  settings.polishing = options.polish;
  return settings;
}

class Osqp final : public QpSolver {
 public:
  Osqp(const QpProblem& problem, const QpOptions& options)
      : problem_(problem), x_(problem.q.size()), y_(problem.lower.size()) {
    const OSQPSettings settings = settings_for(options);
    const Columns p(problem.P), a(problem.A);
    limit_bounds();
    OSQPSolver* solver = nullptr;
    const OSQPInt flag = osqp_setup(&solver, &p.view, problem.q.data(), &a.view, problem_.lower.data(),
                                    problem_.upper.data(), problem.rows(), problem.variables(), &settings);
    solver_.reset(solver);
    not_convex_ = flag == OSQP_NONCVX_ERROR;
    if (flag != 0 && !not_convex_) throw Error(std::string("OSQP: ") + osqp_error_message(flag));
  }

  void update(const QpProblem& problem) override {
    if (problem.P.begin != problem_.P.begin || problem.P.row != problem_.P.row ||
        problem.A.begin != problem_.A.begin || problem.A.row != problem_.A.row)
      throw InputError("quadratic programme: an update must keep the pattern");
    problem_ = problem;
    limit_bounds();
    if (not_convex_) return;
    osqp_update_data_vec(solver_.get(), problem.q.data(), problem_.lower.data(), problem_.upper.data());
    osqp_update_data_mat(solver_.get(), problem.P.value.data(), nullptr, problem.P.entries(),
                         problem.A.value.data(), nullptr, problem.A.entries());
  }

  void warm_start(std::span<const double> x, std::span<const double> y) override {
    if (!not_convex_) osqp_warm_start(solver_.get(), x.data(), y.data());
  }

  QpSummary solve() override {
    QpSummary summary;
    summary.status = QpStatus::not_convex;
    if (not_convex_) return summary;
    osqp_solve(solver_.get());
    const OSQPInfo& info = *solver_->info;
    summary.status = status_of(info.status_val);
    summary.iterations = static_cast<int>(info.iter);
    summary.factorisations = static_cast<int>(info.rho_updates);
    summary.polished = info.status_polish == 1;
    summary.rho = info.rho_estimate;
    const OSQPSolution& s = *solver_->solution;
    const bool dual = summary.status == QpStatus::dual_infeasible,
               primal = summary.status == QpStatus::primal_infeasible;
    std::copy_n(dual ? s.dual_inf_cert : s.x, x_.size(), x_.begin());
    std::copy_n(primal ? s.prim_inf_cert : s.y, y_.size(), y_.begin());
    return summary;
  }

  std::span<const double> x() const override { return x_; }
  std::span<const double> y() const override { return y_; }

 private:
  // The library's infinity is a number.
  void limit_bounds() {
    for (double& bound : problem_.lower) bound = bound <= -kNoBound ? -OSQP_INFTY : bound;
    for (double& bound : problem_.upper) bound = bound >= kNoBound ? OSQP_INFTY : bound;
  }

  static QpStatus status_of(OSQPInt value) {
    switch (value) {
      case OSQP_SOLVED:
        return QpStatus::solved;
      case OSQP_PRIMAL_INFEASIBLE:
        return QpStatus::primal_infeasible;
      case OSQP_DUAL_INFEASIBLE:
        return QpStatus::dual_infeasible;
      case OSQP_NON_CVX:
        return QpStatus::not_convex;
      default:
        return QpStatus::iteration_limit;  // the "inaccurate" ones are not good enough
    }
  }

  QpProblem problem_;
  std::unique_ptr<OSQPSolver, Cleanup> solver_;
  std::vector<double> x_, y_;
  bool not_convex_ = false;
};

}  // namespace

bool osqp_is_there() {
  return true;
}

std::unique_ptr<QpSolver> make_osqp(const QpProblem& problem, const QpOptions& options) {
  return std::make_unique<Osqp>(problem, options);
}

}  // namespace seine::optim

#else

namespace seine::optim {

bool osqp_is_there() {
  return false;
}

std::unique_ptr<QpSolver> make_osqp(const QpProblem&, const QpOptions&) {
  throw Error("Seine was built without OSQP");
}

}  // namespace seine::optim

#endif
