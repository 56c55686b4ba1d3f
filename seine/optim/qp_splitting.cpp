#include "seine/optim/qp_splitting.hpp"

#include <algorithm>
#include <cmath>

#include "seine/base/error.hpp"
#include "seine/optim/qp_interior.hpp"
#include "seine/optim/qp_kkt.hpp"
#include "seine/optim/qp_measure.hpp"
#include "seine/optim/qp_polish.hpp"
#include "seine/optim/qp_scaling.hpp"

namespace seine::optim {
namespace {

constexpr double kRhoLeast = 1e-6, kRhoMost = 1e6;
constexpr double kRhoOfEquation = 1e3;  // relative to ρ [Stellato20, sec. 5.2]
// ρ is chosen anew after so many iterations, and taken over when it differs by more than this factor: each
// change costs a factorisation.
constexpr int kRhoEvery = 50;
constexpr double kRhoFactor = 5.0;
// A polish is tried when the relative residuals are this small, and again whenever they fell by this factor:
// where the active set is clear early, it ends the search.
constexpr double kPolishFirst = 1e-2, kPolishAgain = 0.1;
constexpr int kPolishRounds = 6;
constexpr int kInteriorSteps = 80;

void drop_far_bounds(QpProblem& problem) {
  for (double& bound : problem.lower) bound = bound <= -kNoBound ? -HUGE_VAL : bound;
  for (double& bound : problem.upper) bound = bound >= kNoBound ? HUGE_VAL : bound;
}

class Splitting final : public QpSolver {
 public:
  Splitting(const QpProblem& problem, const QpOptions& options);

  void update(const QpProblem& problem) override;
  void warm_start(std::span<const double> x, std::span<const double> y) override;
  QpSummary solve() override;
  std::span<const double> x() const override { return out_x_; }
  std::span<const double> y() const override { return out_y_; }

 private:
  bool search();
  bool prepare();
  void iterate();
  bool look();
  bool make_exact(bool thoroughly);
  bool primal_infeasible();
  bool dual_infeasible();
  void adapt_rho();
  double judge(std::span<const double> x, std::span<const double> y, double absolute, double relative);
  void unscale(std::span<const double> x, std::span<const double> y);
  void project();
  void forget();
  bool end(QpStatus status) { return summary_.status = status, true; }

  QpOptions options_;
  QpProblem problem_, scaled_;
  QpScaling scaling_;
  KktSystem kkt_;
  QpPolish polish_;
  QpInterior interior_;
  QpMeter meter_;
  QpSummary summary_;
  double rho_, next_polish_ = 0.0;
  bool factorised_ = false, started_ = false, interior_tried_ = false;
  // All scaled: the iterate, its change, the right-hand sides, products for the residuals, a point kept
  // aside.
  std::vector<double> x_, y_, z_, dx_, dy_, rx_, ry_, ax_, px_, aty_, kept_x_, kept_y_;
  std::vector<double> sigma_, penalty_, inverse_penalty_;
  std::vector<double> out_x_, out_y_;
};

Splitting::Splitting(const QpProblem& problem, const QpOptions& options)
    : options_(options),
      problem_(problem),
      scaled_(problem),
      scaling_(problem.variables(), problem.rows()),
      kkt_(problem.P, problem.A),
      polish_(problem.variables(), problem.rows()),
      interior_(problem.variables(), problem.rows()),
      meter_(problem.variables(), problem.rows()),
      rho_(options.rho) {
  const auto n = static_cast<std::size_t>(problem.variables()), m = static_cast<std::size_t>(problem.rows());
  for (auto* v : {&x_, &dx_, &rx_, &px_, &aty_, &kept_x_, &out_x_}) v->resize(n);
  for (auto* v : {&y_, &z_, &dy_, &ry_, &ax_, &kept_y_, &penalty_, &inverse_penalty_, &out_y_}) v->resize(m);
  sigma_.assign(n, options.sigma);
  drop_far_bounds(problem_);
  if (options_.equilibrate)
    scaling_.equilibrate(problem_, scaled_);
  else
    scaling_.apply(problem_, scaled_);
}

void Splitting::update(const QpProblem& problem) {
  const auto same = [](const SparseMatrix& a, const SparseMatrix& b) {
    return a.begin == b.begin && a.row == b.row;
  };
  if (!same(problem.P, problem_.P) || !same(problem.A, problem_.A) ||
      problem.lower.size() != problem_.lower.size() || problem.upper.size() != problem_.upper.size() ||
      problem.q.size() != problem_.q.size())
    throw InputError("quadratic programme: an update must keep the pattern");
  unscale(x_, y_);
  problem_ = problem;
  drop_far_bounds(problem_);
  if (options_.equilibrate && !options_.keep_scaling)
    scaling_.equilibrate(problem_, scaled_);
  else
    scaling_.apply(problem_, scaled_);
  factorised_ = false;
  if (started_) warm_start(out_x_, out_y_);
}

void Splitting::warm_start(std::span<const double> x, std::span<const double> y) {
  for (std::size_t j = 0; j < x_.size(); ++j) x_[j] = x[j] / scaling_.d[j];
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = scaling_.c * y[i] / scaling_.e[i];
  project();
  started_ = true;
}

// z becomes the point nearest to A x within the bounds.
void Splitting::project() {
  multiply(scaled_.A, x_, z_);
  for (std::size_t i = 0; i < z_.size(); ++i)
    z_[i] = std::min(std::max(z_[i], scaled_.lower[i]), scaled_.upper[i]);
}

void Splitting::unscale(std::span<const double> x, std::span<const double> y) {
  for (std::size_t j = 0; j < x.size(); ++j) out_x_[j] = scaling_.d[j] * x[j];
  for (std::size_t i = 0; i < y.size(); ++i) out_y_[i] = scaling_.e[i] * y[i] / scaling_.c;
}

double Splitting::judge(std::span<const double> x, std::span<const double> y, double absolute,
                        double relative) {
  unscale(x, y);
  return meter_.measure(problem_, out_x_, out_y_).ratio(absolute, relative);
}

// Factorises for the present ρ.
bool Splitting::prepare() {
  for (std::size_t i = 0; i < penalty_.size(); ++i) {
    const double low = scaled_.lower[i], high = scaled_.upper[i];
    const bool free = std::isinf(low) && std::isinf(high);
    const double rho = low == high ? kRhoOfEquation * rho_ : free ? kRhoLeast : rho_;
    penalty_[i] = std::clamp(rho, kRhoLeast, kRhoMost);
    inverse_penalty_[i] = 1.0 / penalty_[i];
  }
  ++summary_.factorisations;
  return factorised_ = kkt_.factorise(scaled_.P, scaled_.A, sigma_, inverse_penalty_);
}

// [Stellato20, Alg. 1]
void Splitting::iterate() {
  const double alpha = options_.relaxation;
  for (std::size_t j = 0; j < x_.size(); ++j) rx_[j] = options_.sigma * x_[j] - scaled_.q[j];
  for (std::size_t i = 0; i < y_.size(); ++i) ry_[i] = z_[i] - inverse_penalty_[i] * y_[i];
  kkt_.solve(rx_, ry_);
  for (std::size_t j = 0; j < x_.size(); ++j) {
    dx_[j] = alpha * (rx_[j] - x_[j]);
    x_[j] += dx_[j];
  }
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const double relaxed = z_[i] + alpha * inverse_penalty_[i] * (ry_[i] - y_[i]);
    const double wish = relaxed + inverse_penalty_[i] * y_[i];
    z_[i] = std::min(std::max(wish, scaled_.lower[i]), scaled_.upper[i]);
    dy_[i] = penalty_[i] * (wish - z_[i]) - y_[i];
    y_[i] += dy_[i];
  }
}

// The change of y proves that no x with ‖x‖₁ < 1 / tolerance is feasible: for every feasible x
//   dyᵀA x ≤ Σ (dy⁺ upper − dy⁻ lower) = support < 0,   but   |dyᵀA x| ≤ ‖Aᵀdy‖∞ ‖x‖₁,
// nor feasible but for an error δ of the bounds: that adds ‖dy‖₁ δ to the support.
bool Splitting::primal_infeasible() {
  double support = 0.0, size = 0.0;
  for (std::size_t i = 0; i < dy_.size(); ++i) {
    // Where there is no bound, what little pull is left is rounding.
    double& pull = out_y_[i] = scaling_.e[i] * dy_[i];
    if (std::isinf(problem_.upper[i])) pull = std::min(pull, 0.0);
    if (std::isinf(problem_.lower[i])) pull = std::max(pull, 0.0);
    if (pull != 0.0) support += pull * (pull > 0.0 ? problem_.upper[i] : problem_.lower[i]);
    size += std::abs(pull);
  }
  if (!(support < -options_.absolute * size)) return false;
  multiply_transposed(problem_.A, out_y_, aty_);
  return largest(aty_) <= -options_.infeasible * support;
}

// The change of x is a direction along which the cost falls for ever and no bound is met, to the same
// measure.
bool Splitting::dual_infeasible() {
  for (std::size_t j = 0; j < dx_.size(); ++j) out_x_[j] = scaling_.d[j] * dx_[j];
  const double fall = -dot(problem_.q, out_x_), tolerance = options_.infeasible * fall;
  if (!(fall > 0.0)) return false;
  multiply_symmetric(problem_.P, out_x_, px_);
  if (!(largest(px_) <= tolerance)) return false;
  multiply(problem_.A, out_x_, ax_);
  for (std::size_t i = 0; i < ax_.size(); ++i) {
    if (!std::isinf(problem_.upper[i]) && ax_[i] > tolerance) return false;
    if (!std::isinf(problem_.lower[i]) && ax_[i] < -tolerance) return false;
  }
  return true;
}

// Balances the residuals of the splitting [Stellato20, sec. 5.2].
void Splitting::adapt_rho() {
  multiply(scaled_.A, x_, ax_);
  multiply_symmetric(scaled_.P, x_, px_);
  multiply_transposed(scaled_.A, y_, aty_);
  const double primal_terms = std::max(largest(ax_), largest(z_)),
               dual_terms = std::max({largest(px_), largest(aty_), largest(scaled_.q)});
  for (std::size_t i = 0; i < ax_.size(); ++i) ax_[i] -= z_[i];
  for (std::size_t j = 0; j < px_.size(); ++j) px_[j] += aty_[j] + scaled_.q[j];
  constexpr double kTiny = 1e-10;
  const double primal = largest(ax_) / (primal_terms + kTiny), dual = largest(px_) / (dual_terms + kTiny);
  const double wish = std::clamp(rho_ * std::sqrt((primal + kTiny) / (dual + kTiny)), kRhoLeast, kRhoMost);
  if (wish <= rho_ * kRhoFactor && wish >= rho_ / kRhoFactor) return;
  rho_ = wish;
  factorised_ = false;
}

// Tries to go from the present point to one that is exact but for rounding. @param thoroughly from scratch if
// need be. Without success the point stays.
bool Splitting::make_exact(bool thoroughly) {
  const auto exact = [&](std::span<const double> x, std::span<const double> y) {
    return judge(x, y, options_.polished, options_.polished);
  };
  std::copy(x_.begin(), x_.end(), kept_x_.begin());
  std::copy(y_.begin(), y_.end(), kept_y_.begin());
  factorised_ = false;
  double ratio = HUGE_VAL;
  const auto polish = [&] {
    const auto outcome = polish_.run(scaled_, kkt_, x_, z_, y_, ratio, kPolishRounds, exact);
    summary_.factorisations += outcome.factorisations;
    ratio = outcome.ratio;
  };
  polish();
  if (ratio > 1.0 && thoroughly && !interior_tried_) {
    interior_tried_ = true;
    const auto outcome = interior_.run(scaled_, kkt_, x_, y_, ratio, kInteriorSteps, exact);
    summary_.factorisations += outcome.factorisations;
    ratio = outcome.ratio;
    project();
    polish();
  }
  summary_.polished = ratio <= 1.0;
  if (summary_.polished) return true;
  std::copy(kept_x_.begin(), kept_x_.end(), x_.begin());
  std::copy(kept_y_.begin(), kept_y_.end(), y_.begin());
  project();
  return false;
}

// Whether the present point ends the search; sets the status then.
bool Splitting::look() {
  const double ratio = judge(x_, y_, options_.absolute, options_.relative);
  if (!std::isfinite(ratio)) return end(QpStatus::not_convex);
  const double size = ratio * options_.relative;
  const bool late = summary_.iterations >= options_.interior_after && !interior_tried_;
  if (options_.polish && (ratio <= 1.0 || late || size <= next_polish_)) {
    next_polish_ = kPolishAgain * std::min(size, kPolishFirst / kPolishAgain);
    if (make_exact(ratio <= 1.0 || late)) return end(QpStatus::solved);
  }
  return ratio <= 1.0 && end(QpStatus::solved);
}

bool Splitting::search() {
  // The active set of a problem alike is worth a try, however far off its point is.
  next_polish_ = HUGE_VAL;
  if (started_ && look()) return true;
  next_polish_ = std::min(next_polish_, kPolishFirst);
  while (summary_.iterations++ < options_.max_iterations) {
    if (!factorised_ && !prepare()) return end(QpStatus::not_convex);
    iterate();
    if (summary_.iterations % options_.check_every == 0) {
      if (primal_infeasible()) return end(QpStatus::primal_infeasible);
      if (dual_infeasible()) return end(QpStatus::dual_infeasible);
      if (look()) return true;
    }
    if (options_.adaptive_rho && summary_.iterations % kRhoEvery == 0) adapt_rho();
  }
  --summary_.iterations;
  return end(QpStatus::iteration_limit);
}

void Splitting::forget() {
  for (auto* v : {&x_, &y_, &z_}) std::fill(v->begin(), v->end(), 0.0);
  rho_ = options_.rho;
  started_ = factorised_ = false;
}

QpSummary Splitting::solve() {
  summary_ = {};
  interior_tried_ = false;
  search();
  const QpStatus status = summary_.status;
  summary_.rho = rho_;
  if (status == QpStatus::solved || status == QpStatus::iteration_limit) {
    started_ = true;
    unscale(x_, y_);
  } else {
    forget();  // x() or y() keeps the certificate
  }
  return summary_;
}

}  // namespace

std::unique_ptr<QpSolver> make_splitting(const QpProblem& problem, const QpOptions& options) {
  return std::make_unique<Splitting>(problem, options);
}

}  // namespace seine::optim
