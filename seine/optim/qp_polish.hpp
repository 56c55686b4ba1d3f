#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "seine/optim/qp.hpp"
#include "seine/optim/qp_kkt.hpp"

namespace seine::optim {

/// Takes a rough solution to rounding accuracy: guesses which bounds are active, solves the equations that
/// follow [Stellato20, sec. 4], and corrects the guess where the result says so, for a few rounds
/// (primal-dual active set [Hintermueller02]). From the solution of a similar problem this alone is often
/// enough.
class QpPolish {
 public:
  QpPolish(int variables, int rows);

  struct Outcome {
    double ratio;  ///< of x and y as they are left
    int factorisations = 0;
  };
  /// Works in the scaled problem from x, z (near A x, within the bounds) and y.
  /// @param ratio of the point given  @param rounds at most  @param judge ratio of residual to tolerance of a
  /// point: x and y are replaced by what has a smaller one; ≤ 1 ends the rounds. `kkt` is left with numbers
  /// of its own.
  template <class Judge>
  Outcome run(const QpProblem& scaled, KktSystem& kkt, std::span<double> x, std::span<const double> z,
              std::span<double> y, double ratio, int rounds, const Judge& judge) {
    Outcome outcome{ratio};
    guess(scaled, z, y);
    while (outcome.factorisations++ < rounds && solve(scaled, kkt)) {
      const double now = judge(std::span<const double>(x_), std::span<const double>(y_));
      if (now < outcome.ratio) {
        outcome.ratio = now;
        std::copy(x_.begin(), x_.end(), x.begin());
        std::copy(y_.begin(), y_.end(), y.begin());
      }
      if (outcome.ratio <= 1.0 || !correct(scaled)) break;
    }
    return outcome;
  }

 private:
  void guess(const QpProblem& scaled, std::span<const double> z, std::span<const double> y);
  bool solve(const QpProblem& scaled, KktSystem& kkt);
  void residual(const QpProblem& scaled);
  bool correct(const QpProblem& scaled);

  std::vector<char> active_, at_upper_;
  std::vector<double> x_, y_, d_, e_, rx_, ry_, ax_;
};

}  // namespace seine::optim
