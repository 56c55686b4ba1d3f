#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "seine/optim/qp.hpp"
#include "seine/optim/qp_kkt.hpp"

namespace seine::optim {

/// A primal-dual interior point method with Mehrotra's predictor and corrector [Mehrotra92], for problems on
/// which splitting crawls: degenerate ones with little curvature. It cannot use a start, but needs some
/// twenty steps whatever the problem. With A x = s, lower ≤ s ≤ upper, y = v − w, it follows
///   v (upper − s) = μ,  w (s − lower) = μ,  μ → 0.
class QpInterior {
 public:
  QpInterior(int variables, int rows);

  struct Outcome {
    double ratio;  ///< of the point left in x and y
    int factorisations = 0;
  };
  /// Works in the scaled problem. @param judge ratio of residual to tolerance of a point; ≤ 1 ends the search
  /// @param ratio x and y are replaced by a point that has a smaller one. `kkt` is left with numbers of its
  /// own.
  template <class Judge>
  Outcome run(const QpProblem& scaled, KktSystem& kkt, std::span<double> x, std::span<double> y, double ratio,
              int steps, const Judge& judge) {
    Outcome outcome{ratio, 1};
    if (!begin(scaled, kkt)) return outcome;
    while (outcome.factorisations++ < steps && step(scaled, kkt)) {
      const double now = judge(std::span<const double>(x_), std::span<const double>(y_));
      if (now < outcome.ratio) {
        outcome.ratio = now;
        std::copy(x_.begin(), x_.end(), x.begin());
        std::copy(y_.begin(), y_.end(), y.begin());
      }
      if (outcome.ratio <= 1.0) break;
    }
    return outcome;
  }

 private:
  // A row's distances to its bounds and their multipliers, with their changes in a step.
  struct Row {
    bool bounded_below, bounded_above;
    double low, high;
    double w, v, dw, dv;

    bool bounded() const { return bounded_below || bounded_above; }
    double theta() const { return (bounded_below ? w / low : 0.0) + (bounded_above ? v / high : 0.0); }
  };

  bool begin(const QpProblem& scaled, KktSystem& kkt);
  bool minimise_roughly(const QpProblem& scaled, KktSystem& kkt);
  bool step(const QpProblem& scaled, KktSystem& kkt);
  void residuals(const QpProblem& scaled);
  void direction(const QpProblem& scaled, KktSystem& kkt, double mu, bool correct);
  void solve(const QpProblem& scaled, KktSystem& kkt);
  double longest() const;
  double complementarity(double length) const;
  void move(double length);

  std::vector<Row> rows_;
  std::vector<char> kept_;
  std::vector<double> x_, s_, y_, dx_, ds_, dy_, rd_, rp_, c_, d_, e_, bx_, by_;
};

}  // namespace seine::optim
