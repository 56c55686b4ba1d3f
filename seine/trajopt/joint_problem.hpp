#pragma once

#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/base/workers.hpp"
#include "seine/optim/lbfgs.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/trajopt/proximity.hpp"
#include "seine/trajopt/robot_problem.hpp"

namespace seine::trajopt {

/// Everything the joint problem is made of; SI units unless said otherwise.
struct Task {
  std::vector<const RobotTask*> robots;  ///< must outlive the problem
  std::vector<const Body*> bodies;       ///< in units; must outlive the problem
  double robot_clearance = 0.05;         ///< m, between footprints
  std::vector<double> extra;    ///< m, robots × (robots + bodies), added to their clearance; may be empty
  std::vector<Demand> demands;  ///< per robot; may be empty
  double tick = 0.05;           ///< s, spacing of the common clock's samples
  int ticks = 1;                ///< the clock ends when everything has come to rest
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

  int variables() const { return offsets_.back(); }
  std::vector<double> initial() const;
  /// Where each robot's variables begin; one more entry for the end.
  const std::vector<int>& offsets() const { return offsets_; }
  /// J and its gradient with the present lists of near pairs.
  double evaluate(std::span<const double> x, std::span<double> gradient, double knee);
  /// Finds again who is near whom.
  void refresh(std::span<const double> x);

  /// Soft knee, then stiff. `x` is improved in place.
  SolveSummary solve(std::span<double> x, const Deadline& deadline, bool stiff_only = false);
  traj::TeamTrajectory trajectory(std::span<const double> x);

 private:
  void load(std::span<const double> x);

  Settings settings_;
  Workers& workers_;
  Units units_;
  std::vector<RobotProblem> robots_;
  std::vector<int> offsets_;  // of each robot's variables; one more entry for the end
  Proximity proximity_;
  std::vector<ClockState> states_;  // robots × ticks
  std::vector<double> costs_, chunk_costs_;
  double tick_;  // units
  int ticks_;
};

}  // namespace seine::trajopt
