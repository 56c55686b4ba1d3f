#pragma once

#include <span>
#include <vector>

#include "seine/mpc/options.hpp"
#include "seine/mpc/reference.hpp"

namespace seine::mpc {

/// The supplement's quadratic programme, linearised at the reference and in deviations from it: for k = 0 … K
/// − 1 the variables w_k = U_k − U_k^ref and e_{k+1} = X_{k+1} − X_{k+1}^ref, and the rows
///   e_{k+1} = A_k e_k + B_k w_k + d_k,   |U_k − λ U_{k−1}| ≤ (1 − λ) U_max,   |U_k − U_{k−1}| ≤ U_dmax,
///   X_{k+1} within X_max.
/// U_{−1} is the input that acts now, so that the first change is limited and priced as well. λ = e^{−Δt/lag}
/// is what is left of an input after a step: only so much can an actuator do that lags behind its commands,
/// which are at most U_max. Without lag λ = 0, and the row is the limit of the input itself. Where a car is
/// too fast, the speed limit is what the hardest braking reaches: there is always a solution.
class TrackingQp {
 public:
  static constexpr int kVariables = 6, kRows = 9;  ///< of one step

  TrackingQp(const vehicle::Model& model, const Options& options);

  /// New numbers, without allocating. @param now X_0  @param last U_{−1}  @param reference K + 1 samples,
  /// from X_0^ref on
  void set(const State& now, const Input& last, std::span<const Sample> reference);
  const optim::QpProblem& problem() const { return problem_; }

  /// U_k of a solution, within the limits to the bit.
  Input input(std::span<const double> solution, int k) const;
  /// Moves a solution, or its multipliers, on by one step: `block` entries a step, the last one stays.
  static void shift(std::span<double> values, int block);

  Input most() const { return most_; }           ///< U_max
  Input most_change() const { return change_; }  ///< U_dmax

 private:
  void lay_out();
  void price();
  double steering_price(double speed) const;
  void price_steering(std::span<const Sample> reference);
  void set_model(std::size_t k, const LinearModel& m, const StateVector& drift);
  void set_bounds(const State& now, const Input& last, std::span<const Sample> reference);

  Options options_;
  vehicle::Model model_;
  int horizon_;
  Input most_, change_;
  double kept_, first_kept_;  // λ; of the input that acts now, on average over the first period
  optim::QpProblem problem_;
  std::vector<int>
      dynamics_;  // where in A's values: per step 4 × 4 of −A_k (none for k = 0), 4 × 2 of −B_k; −1: no entry
  std::vector<double> prices_;  // of steering, at each step: a factor on its weights
  std::vector<Input> reference_;
};

}  // namespace seine::mpc
