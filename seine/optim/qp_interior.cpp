#include "seine/optim/qp_interior.hpp"

#include <cmath>

namespace seine::optim {
namespace {

// Keeps the system quasi-definite; refinement takes its effect out again.
constexpr double kRegularisation = 1e-8;
constexpr int kRefinements = 4;
constexpr double kBoundary = 0.995;  // share of the way to the boundary that a step may go
// A step shorter than this is taken again towards the middle of the feasible set, by halving μ.
constexpr double kShort = 0.1, kCentring = 0.5;
// Below these nothing moves any more.
constexpr double kLeastStep = 1e-12, kLeastProduct = 1e-18;

}  // namespace

QpInterior::QpInterior(int variables, int rows) : rows_(static_cast<std::size_t>(rows)), kept_(rows_.size()) {
  for (auto* v : {&x_, &dx_, &rd_, &d_, &bx_}) v->resize(static_cast<std::size_t>(variables));
  for (auto* v : {&s_, &y_, &ds_, &dy_, &rp_, &c_, &e_, &by_}) v->resize(rows_.size());
}

// min ½ xᵀP x + qᵀx + ½‖x‖² + ½ Σ (A x − bound)², bound the middle where there are two.
bool QpInterior::minimise_roughly(const QpProblem& scaled, KktSystem& kkt) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double low = scaled.lower[i], high = scaled.upper[i];
    const bool equation = low == high, below = !std::isinf(low), above = !std::isinf(high);
    rows_[i] = {.bounded_below = below && !equation, .bounded_above = above && !equation};
    kept_[i] = below || above;
    e_[i] = equation ? kRegularisation : 1.0;
    y_[i] = below && above ? 0.5 * (low + high) : below ? low : above ? high : 0.0;
  }
  for (std::size_t j = 0; j < x_.size(); ++j) x_[j] = -scaled.q[j];
  std::fill(d_.begin(), d_.end(), 1.0);
  if (!kkt.factorise(scaled.P, scaled.A, d_, e_, kept_)) return false;
  kkt.solve(x_, y_);
  return true;
}

// From there s is moved inside its bounds, and all multipliers are kept off zero, by more than the worst of
// each misses, as in [Vandenberghe10, sec. 5.3].
bool QpInterior::begin(const QpProblem& scaled, KktSystem& kkt) {
  if (!minimise_roughly(scaled, kkt)) return false;
  std::fill(d_.begin(), d_.end(), kRegularisation);
  multiply(scaled.A, x_, s_);
  double miss = 0.0, pull = 0.0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    miss = std::max({miss, scaled.lower[i] - s_[i], s_[i] - scaled.upper[i]});
    if (rows_[i].bounded()) pull = std::max(pull, std::abs(y_[i]));
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double low = scaled.lower[i], high = scaled.upper[i];
    Row& row = rows_[i];
    const bool both = row.bounded_below && row.bounded_above;
    const double inside = both ? std::min(1.0 + miss, 0.3 * (high - low)) : 1.0 + miss;
    if (row.bounded_below) s_[i] = std::max(s_[i], low + inside), row.w = 1.0 + pull;
    if (row.bounded_above) s_[i] = std::min(s_[i], high - inside), row.v = 1.0 + pull;
    if (low == high) s_[i] = low;
    if (low != high) y_[i] = row.v - row.w;
    row.low = s_[i] - low, row.high = high - s_[i];
  }
  return true;
}

void QpInterior::residuals(const QpProblem& scaled) {
  multiply_symmetric(scaled.P, x_, rd_);
  add_transposed(scaled.A, y_, rd_);
  for (std::size_t j = 0; j < rd_.size(); ++j) rd_[j] += scaled.q[j];
  multiply(scaled.A, x_, rp_);
  for (std::size_t i = 0; i < rp_.size(); ++i) rp_[i] = kept_[i] ? rp_[i] - s_[i] : 0.0;
}

// P dx + Aᵀdy = −rd,  A dx − e (dy − c) = −rp.
void QpInterior::solve(const QpProblem& scaled, KktSystem& kkt) {
  std::fill(dx_.begin(), dx_.end(), 0.0);
  std::fill(dy_.begin(), dy_.end(), 0.0);
  for (int pass = 0; pass <= kRefinements; ++pass) {
    multiply_symmetric(scaled.P, dx_, bx_);
    add_transposed(scaled.A, dy_, bx_);
    for (std::size_t j = 0; j < bx_.size(); ++j) bx_[j] = -rd_[j] - bx_[j];
    multiply(scaled.A, dx_, by_);
    for (std::size_t i = 0; i < by_.size(); ++i)
      by_[i] = kept_[i] ? -rp_[i] - by_[i] + e_[i] * (dy_[i] - c_[i]) : 0.0;
    kkt.solve(bx_, by_);
    for (std::size_t j = 0; j < dx_.size(); ++j) dx_[j] += bx_[j];
    for (std::size_t i = 0; i < dy_.size(); ++i) dy_[i] += kept_[i] ? by_[i] : 0.0;
  }
}

// The Newton step towards the point of the central path at `mu`: with θ = v/high + w/low, ds = (dy − c)/θ.
// @param correct takes the products of the last direction's changes into account
void QpInterior::direction(const QpProblem& scaled, KktSystem& kkt, double mu, bool correct) {
  const auto below = [&](std::size_t i) {
    return (mu - (correct ? ds_[i] * rows_[i].dw : 0.0)) / rows_[i].low - rows_[i].w;
  };
  const auto above = [&](std::size_t i) {
    return (mu + (correct ? ds_[i] * rows_[i].dv : 0.0)) / rows_[i].high - rows_[i].v;
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    // What the multipliers change by if s stays.
    row.dw = row.bounded_below ? below(i) : 0.0;
    row.dv = row.bounded_above ? above(i) : 0.0;
    c_[i] = row.dv - row.dw;
    e_[i] = row.bounded() ? 1.0 / row.theta() : 0.0;
  }
  solve(scaled, kkt);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    ds_[i] = e_[i] * (dy_[i] - c_[i]);
    if (row.bounded_below) row.dw -= row.w / row.low * ds_[i];
    if (row.bounded_above) row.dv += row.v / row.high * ds_[i];
  }
}

double QpInterior::longest() const {
  double length = 1.0;
  const auto bound = [&](double value, double change) {
    if (change < 0.0) length = std::min(length, -kBoundary * value / change);
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (row.bounded_below) bound(row.low, ds_[i]), bound(row.w, row.dw);
    if (row.bounded_above) bound(row.high, -ds_[i]), bound(row.v, row.dv);
  }
  return length;
}

// Mean of the products μ after a step of this length.
double QpInterior::complementarity(double length) const {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (row.bounded_below) sum += (row.low + length * ds_[i]) * (row.w + length * row.dw), ++count;
    if (row.bounded_above) sum += (row.high - length * ds_[i]) * (row.v + length * row.dv), ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

void QpInterior::move(double length) {
  for (std::size_t j = 0; j < x_.size(); ++j) x_[j] += length * dx_[j];
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    s_[i] += length * ds_[i];
    row.low += length * ds_[i], row.high -= length * ds_[i];
    row.w += length * row.dw, row.v += length * row.dv;
    y_[i] = row.bounded() ? row.v - row.w : y_[i] + length * dy_[i];
  }
}

bool QpInterior::step(const QpProblem& scaled, KktSystem& kkt) {
  residuals(scaled);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double exact = rows_[i].bounded() ? 1.0 / rows_[i].theta() : (kept_[i] ? 0.0 : 1.0);
    e_[i] = exact + kRegularisation;
  }
  if (!kkt.factorise(scaled.P, scaled.A, d_, e_, kept_)) return false;
  const double mu = complementarity(0.0);
  direction(scaled, kkt, 0.0, false);
  const double left = mu > 0.0 ? complementarity(longest()) / mu : 0.0;
  direction(scaled, kkt, mu * left * left * left, true);
  double length = longest();
  if (length < kShort) {
    direction(scaled, kkt, kCentring * mu, false);
    length = longest();
  }
  move(length);
  return std::isfinite(length) && length > kLeastStep && (mu > kLeastProduct || mu == 0.0);
}

}  // namespace seine::optim
