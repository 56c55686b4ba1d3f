#include "seine/optim/qp_polish.hpp"

#include <cmath>

namespace seine::optim {
namespace {

// Keeps the system solvable where active rows depend on each other or P has no curvature; the refinement
// takes its effect out again.
constexpr double kRegularisation = 1e-8;
constexpr int kRefinements = 12;
constexpr double kRefined = 1e-14;  // of the residual, relative to the right hand side
// Violations and wrong signs below this are rounding.
constexpr double kSlack = 1e-11;

}  // namespace

QpPolish::QpPolish(int variables, int rows)
    : active_(static_cast<std::size_t>(rows)),
      at_upper_(active_.size()),
      x_(static_cast<std::size_t>(variables)),
      y_(active_.size()),
      d_(x_.size(), kRegularisation),
      e_(active_.size()),
      rx_(x_.size()),
      ry_(active_.size()),
      ax_(active_.size()) {}

// A bound is taken for active when the multiplier is larger than the distance to it.
void QpPolish::guess(const QpProblem& scaled, std::span<const double> z, std::span<const double> y) {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const bool low = z[i] - scaled.lower[i] < -y[i], high = scaled.upper[i] - z[i] < y[i];
    active_[i] = low || high || scaled.lower[i] == scaled.upper[i];
    at_upper_[i] = high;
  }
}

// Solves  P x + Aᵀy = −q,  and for every row  A_i x = bound_i or y_i = 0.
bool QpPolish::solve(const QpProblem& scaled, KktSystem& kkt) {
  for (std::size_t i = 0; i < active_.size(); ++i) e_[i] = active_[i] ? kRegularisation : 1.0;
  if (!kkt.factorise(scaled.P, scaled.A, d_, e_, active_)) return false;
  std::fill(x_.begin(), x_.end(), 0.0);
  std::fill(y_.begin(), y_.end(), 0.0);
  double first = 0.0, last = HUGE_VAL;
  for (int pass = 0; pass <= kRefinements; ++pass) {
    residual(scaled);
    const double size = std::max(largest(rx_), largest(ry_));
    if (pass == 0) first = size;
    if (!(size > kRefined * first) || size > 0.9 * last) break;
    last = size;
    kkt.solve(rx_, ry_);
    for (std::size_t j = 0; j < x_.size(); ++j) x_[j] += rx_[j];
    for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += active_[i] ? ry_[i] : 0.0;
  }
  return true;
}

void QpPolish::residual(const QpProblem& scaled) {
  multiply(scaled.A, x_, ax_);
  for (std::size_t i = 0; i < ry_.size(); ++i)
    ry_[i] = active_[i] ? (at_upper_[i] ? scaled.upper[i] : scaled.lower[i]) - ax_[i] : 0.0;
  multiply_symmetric(scaled.P, x_, rx_);
  add_transposed(scaled.A, y_, rx_);
  for (std::size_t j = 0; j < rx_.size(); ++j) rx_[j] = -rx_[j] - scaled.q[j];
}

// Bounds crossed become active, bounds that pull instead of push are let go. Returns whether anything
// changed.
bool QpPolish::correct(const QpProblem& scaled) {
  bool changed = false;
  multiply(scaled.A, x_, ax_);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (scaled.lower[i] == scaled.upper[i]) continue;
    if (active_[i]) {
      if (at_upper_[i] ? y_[i] >= -kSlack : y_[i] <= kSlack) continue;
      active_[i] = 0;
    } else {
      const bool low = ax_[i]<scaled.lower[i] - kSlack, high = ax_[i]> scaled.upper[i] + kSlack;
      if (!low && !high) continue;
      active_[i] = 1, at_upper_[i] = high;
    }
    changed = true;
  }
  return changed;
}

}  // namespace seine::optim
