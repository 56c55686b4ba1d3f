#pragma once

#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/base/workers.hpp"
#include "seine/baseline/letter/team_terms.hpp"
#include "seine/optim/lbfgs.hpp"

namespace seine::baseline::letter {

/// The team's task after the guess.
struct TeamTask {
  std::vector<RobotTask> robots;
  double robot_clearance = 0.05;  ///< m
  std::optional<NetTask> net;
};

/// What the method says of its own result.
struct Claim {
  bool holds = false;
  std::string reason = "not run";  ///< why not
  Worst worst{};
};

/// The letter's joint problem, unconstrained:
///   Σ_k ( ∫ σ⃛ᵀ W σ⃛ dt + w_T · duration ) + Ψ + Σ_d w_d ∫ L1(𝒢_d) dt.
/// The value does not depend on the number of threads.
class Problem {
 public:
  /// @param task, workers must outlive the problem
  Problem(const TeamTask& task, const Settings& settings, Workers& workers);

  int variables() const { return offsets_.back(); }
  std::vector<double> initial() const;
  double evaluate(std::span<const double> x, std::span<double> gradient);
  /// One L-BFGS run from x, in place.
  optim::LbfgsSummary solve(std::span<double> x, const Deadline& deadline);
  /// At x, after `solve`.
  Claim claim(std::span<const double> x, const optim::LbfgsSummary& summary);
  traj::TeamTrajectory trajectory(std::span<const double> x);

 private:
  template <class Span>
  Span part(Span x, std::size_t robot) const {
    return x.subspan(static_cast<std::size_t>(offsets_[robot]),
                     static_cast<std::size_t>(offsets_[robot + 1] - offsets_[robot]));
  }

  // Robots are dealt out to this many shares, each with its own gradients of all robots.
  static constexpr int kShares = 8;

  Settings settings_;
  Workers& workers_;
  std::vector<RobotTerms> robots_;
  TeamTerms team_;
  std::vector<int> offsets_{0};
  std::vector<Share> shares_;
  std::vector<CurveGradient> total_;
  std::vector<double> costs_;
};

}  // namespace seine::baseline::letter
