#include "seine/optim/lbfgs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/base/error.hpp"

namespace seine::optim {
namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  const std::size_t n = a.size();
  const double *pa = a.data(), *pb = b.data();
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += pa[i] * pb[i];
  return sum;
}

void add_scaled(double factor, std::span<const double> a, std::span<double> b) {
  const std::size_t n = a.size();
  const double* pa = a.data();
  double* pb = b.data();
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) pb[i] += factor * pa[i];
}

double largest(std::span<const double> a) {
  double m = 0.0;
  for (const double v : a) m = std::max(m, std::abs(v));
  return m;
}

// The inverse Hessian of one group of variables, as its last steps s and gradient changes y.
class BlockMemory {
 public:
  BlockMemory(std::size_t begin, std::size_t size, int memory)
      : begin_(begin),
        size_(size),
        slots_(static_cast<std::size_t>(memory)),
        steps_(slots_ * size),
        changes_(slots_ * size),
        rho_(slots_),
        alpha_(slots_) {}

  void push(std::span<const double> step, std::span<const double> change) {
    const auto s = step.subspan(begin_, size_), y = change.subspan(begin_, size_);
    const double sy = dot(s, y), yy = dot(y, y), ss = dot(s, s);
    // Powell-style guard: a pair without curvature would spoil the group's metric.
    if (!(sy > 1e-10 * std::sqrt(ss * yy)) || yy <= 0.0) return;
    std::copy(s.begin(), s.end(), step_of(next_).begin());
    std::copy(y.begin(), y.end(), change_of(next_).begin());
    rho_[next_] = 1.0 / sy;
    scale_ = sy / yy;
    next_ = (next_ + 1) % slots_;
    used_ = std::min(used_ + 1, slots_);
  }

  // direction ← −H g on this group (two-loop recursion).
  void direction(std::span<const double> gradient, std::span<double> out) {
    const auto g = gradient.subspan(begin_, size_);
    const auto d = out.subspan(begin_, size_);
    for (std::size_t i = 0; i < size_; ++i) d[i] = -g[i];
    if (used_ == 0) return;
    for (std::size_t k = 0; k < used_; ++k) {
      const std::size_t slot = (next_ + slots_ - 1 - k) % slots_;
      alpha_[slot] = rho_[slot] * dot(step_of(slot), d);
      add_scaled(-alpha_[slot], change_of(slot), d);
    }
    for (double& v : d) v *= scale_;
    for (std::size_t k = used_; k-- > 0;) {
      const std::size_t slot = (next_ + slots_ - 1 - k) % slots_;
      const double beta = rho_[slot] * dot(change_of(slot), d);
      add_scaled(alpha_[slot] - beta, step_of(slot), d);
    }
  }

  bool empty() const { return used_ == 0; }
  void clear() { used_ = 0; }

 private:
  std::span<double> step_of(std::size_t slot) { return {&steps_[slot * size_], size_}; }
  std::span<double> change_of(std::size_t slot) { return {&changes_[slot * size_], size_}; }

  std::size_t begin_, size_, slots_;
  std::vector<double> steps_, changes_, rho_, alpha_;
  std::size_t next_ = 0, used_ = 0;
  double scale_ = 1.0;
};

class Minimizer {
 public:
  Minimizer(const Objective& objective, std::span<double> x, const LbfgsOptions& options)
      : objective_(objective),
        options_(options),
        x_(x),
        gradient_(x.size()),
        trial_(x.size()),
        trial_gradient_(x.size()),
        direction_(x.size()) {
    std::vector<int> begins = options.blocks.empty() ? std::vector<int>{0} : options.blocks;
    begins.push_back(static_cast<int>(x.size()));
    for (std::size_t b = 0; b + 1 < begins.size(); ++b)
      if (begins[b + 1] > begins[b])
        blocks_.emplace_back(static_cast<std::size_t>(begins[b]),
                             static_cast<std::size_t>(begins[b + 1] - begins[b]), options.memory);
  }

  LbfgsSummary run() {
    cost_ = evaluate(x_, gradient_);
    summary_.initial_cost = cost_;
    if (!std::isfinite(cost_)) throw Error("the objective is not finite at the starting point");
    history_.push_back(cost_);
    summary_.status = LbfgsStatus::evaluation_limit;
    while (summary_.evaluations < options_.max_evaluations) {
      if (largest(gradient_) <= options_.gradient_tolerance * std::max(1.0, largest(x_))) {
        summary_.status = LbfgsStatus::small_gradient;
        break;
      }
      if (!iterate()) {
        summary_.status = LbfgsStatus::no_step;
        break;
      }
      if (options_.changed && options_.changed(summary_.iterations)) start_over();
      if (finished()) break;
    }
    summary_.cost = cost_;
    return summary_;
  }

 private:
  double evaluate(std::span<const double> x, std::span<double> gradient) {
    ++summary_.evaluations;
    return objective_(x, gradient);
  }

  // The objective is another one from here on; what was learnt of its curvature still serves.
  void start_over() {
    const double before = cost_;
    cost_ = evaluate(x_, gradient_);
    for (double& cost : history_) cost += cost_ - before;
  }

  bool iterate() {
    bool fresh = true;
    for (auto& block : blocks_) {
      block.direction(gradient_, direction_);
      fresh = fresh && block.empty();
    }
    if (!(dot(direction_, gradient_) < 0.0)) {
      for (auto& block : blocks_) block.clear();
      for (std::size_t i = 0; i < direction_.size(); ++i) direction_[i] = -gradient_[i];
      fresh = true;
    }
    // Without any curvature knowledge a unit step is meaningless; begin with a tenth of a unit of the
    // variables.
    double step = fresh ? 0.1 / std::max(1e-12, largest(direction_)) : 1.0;
    step = std::min(step, options_.max_step / std::max(1e-300, largest(direction_)));
    if (!search(step)) return false;
    for (std::size_t i = 0; i < trial_.size(); ++i) {
      const double s = trial_[i] - x_[i], y = trial_gradient_[i] - gradient_[i];
      x_[i] = trial_[i];
      gradient_[i] = trial_gradient_[i];
      trial_[i] = s;
      trial_gradient_[i] = y;
    }
    for (auto& block : blocks_) block.push(trial_, trial_gradient_);
    cost_ = trial_cost_;
    ++summary_.iterations;
    return true;
  }

  // Bisection for weak Wolfe conditions [Lewis13, Algorithm 2.6].
  bool search(double step) {
    constexpr int kMaxTrials = 30;
    const double slope = dot(direction_, gradient_);
    double low = 0.0, high = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < kMaxTrials; ++trial) {
      for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = x_[i] + step * direction_[i];
      trial_cost_ = evaluate(trial_, trial_gradient_);
      const bool decreased =
          trial_cost_ <= cost_ + options_.sufficient_decrease * step * slope;  // false for NaN
      if (!decreased)
        high = step;
      else if (dot(direction_, trial_gradient_) < options_.curvature * slope)
        low = step;
      else
        return true;
      if (summary_.evaluations >= options_.max_evaluations) return decreased;
      step = std::isfinite(high) ? 0.5 * (low + high) : 2.0 * low;
    }
    return trial_cost_ < cost_;
  }

  bool finished() {
    if (options_.stop && options_.stop(summary_.iterations, cost_)) {
      summary_.status = LbfgsStatus::stopped;
      return true;
    }
    history_.push_back(cost_);
    const auto past = static_cast<std::size_t>(options_.past);
    if (history_.size() > past) {
      const double before = history_[history_.size() - 1 - past];
      if (before - cost_ < options_.decrease_tolerance * std::max(1e-12, std::abs(cost_))) {
        summary_.status = LbfgsStatus::converged;
        return true;
      }
    }
    return false;
  }

  const Objective& objective_;
  const LbfgsOptions& options_;
  std::span<double> x_;
  std::vector<double> gradient_, trial_, trial_gradient_, direction_, history_;
  std::vector<BlockMemory> blocks_;
  double cost_ = 0.0, trial_cost_ = 0.0;
  LbfgsSummary summary_;
};

}  // namespace

const char* name_of(LbfgsStatus status) {
  switch (status) {
    case LbfgsStatus::not_run:
      return "not run";
    case LbfgsStatus::converged:
      return "converged";
    case LbfgsStatus::small_gradient:
      return "small gradient";
    case LbfgsStatus::evaluation_limit:
      return "evaluation limit";
    case LbfgsStatus::stopped:
      return "stopped";
    case LbfgsStatus::no_step:
      return "no step";
  }
  return "?";
}

LbfgsSummary minimize(const Objective& objective, std::span<double> x, const LbfgsOptions& options) {
  return Minimizer(objective, x, options).run();
}

}  // namespace seine::optim
