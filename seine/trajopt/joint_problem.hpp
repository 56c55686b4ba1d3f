#pragma once

#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/base/workers.hpp"
#include "seine/optim/lbfgs.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/trajopt/net_terms.hpp"
#include "seine/trajopt/proximity.hpp"
#include "seine/trajopt/robot_problem.hpp"

namespace seine::trajopt {

/// Everything the joint problem is made of; SI units unless said otherwise.
struct Task {
  std::vector<const RobotTask*> robots;  ///< must outlive the problem
  std::vector<const Body*> bodies;       ///< in units; must outlive the problem
  double robot_clearance = 0.05;         ///< m, between footprints
  std::vector<double> extra;     ///< m, robots × (robots + bodies), added to their clearance; may be empty
  std::vector<Demand> demands;   ///< per robot; may be empty
  double tick = 0.05;            ///< s, spacing of the common clock's samples
  int ticks = 1;                 ///< the clock ends when everything has come to rest
  const NetTask* net = nullptr;  ///< held by the robots in their order; must outlive the problem
  /// All robots share one timing: progress, durations, waits and accelerations at rests are one set of
  /// variables. Needs robots with equally many segments and pieces. A team that holds a net moves as one.
  bool one_timing = false;
  Units units;  ///< see units_of; the same for every subset of a team, so that variables can be carried over
};

/// The units to make a team dimensionless with: the median car length, and the time to drive it at that car's
/// top speed.
Units units_of(std::span<const RobotTask> robots);

struct SolveSummary {
  int soft_evaluations = 0, stiff_evaluations = 0;
  double cost = 0.0;
  bool finished = false;  ///< false when the deadline cut it short
};

/// All cars together: own cost of each, plus the distances between them on the common clock. min J(x) over
/// all variables, unconstrained.
class JointProblem {
 public:
  JointProblem(const Task& task, const Settings& settings, Workers& workers);

  int variables() const { return variables_; }
  std::vector<double> initial() const;
  /// Where each robot's variables begin when timings are its own; one more entry for the end.
  const std::vector<int>& offsets() const { return offsets_; }
  /// J and its gradient with the present lists of near pairs.
  double evaluate(std::span<const double> x, std::span<double> gradient, double knee);
  /// Finds again who is near whom.
  void refresh(std::span<const double> x);

  /// Soft knee, then stiff. `x` is improved in place.
  SolveSummary solve(std::span<double> x, const Deadline& deadline, bool stiff_only = false);
  traj::TeamTrajectory trajectory(std::span<const double> x);

 private:
  std::span<const double> own(std::span<const double> x);
  std::span<const double> of(std::span<const double> own_x, std::size_t robot) const;
  void tie();
  void load(std::span<const double> x);
  void find_shared_ticks();
  void locate(std::size_t robot);
  void pull_back(std::size_t robot);
  double team_cost(double knee);
  ClockState& state(std::size_t robot, int tick) {
    return states_[robot * static_cast<std::size_t>(ticks_) + static_cast<std::size_t>(tick)];
  }

  Settings settings_;
  Workers& workers_;
  Units units_;
  std::vector<RobotProblem> robots_;
  std::vector<int> offsets_;  // of each robot's variables; one more entry for the end
  int variables_ = 0;
  // With one timing: which variable each robot's own one is, and the robots' own values and gradients.
  std::vector<int> tied_;
  std::vector<double> own_x_, own_gradient_;
  // With one timing all clocks are the same: the ticks, ascending, and what they are on it.
  std::vector<int> needed_by_any_;
  std::vector<Moment> shared_moments_;
  Proximity proximity_;
  std::optional<NetTerms> net_;
  std::vector<std::vector<int>> needed_;  // per robot: ticks that terms look at, ascending
  std::vector<ClockState> states_;        // robots × ticks
  std::vector<ClockState> moments_;       // robots × the net's moments
  std::vector<double> costs_, chunk_costs_;
  double tick_;  // units
  int ticks_;
};

}  // namespace seine::trajopt
