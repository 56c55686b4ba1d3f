#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "seine/mpc/actuators.hpp"
#include "seine/mpc/tracking_qp.hpp"

namespace seine::mpc {

/// Where a command came from.
enum class Source {
  tracking,  ///< this step's plan
  reused,    ///< the last good plan, because this step's failed
  stopping,  ///< a controlled stop, because plans have failed for too long
};

struct Command {
  Input input;
  Source source = Source::stopping;
  optim::QpSummary qp;  ///< of this step; not run where the input was not fit for it
};

/// Model predictive tracking of a reference as in the supplement: at every step the bicycle is linearised,
/// and the quadratic programme of `TrackingQp` solved from the last solution. Allocates nothing after
/// construction.
class Tracker {
 public:
  using SolverFactory =
      std::function<std::unique_ptr<optim::QpSolver>(const optim::QpProblem&, const optim::QpOptions&)>;
  /// Throws InputError when the options have complaints. @param make_solver for tests; by default the one the
  /// options name
  explicit Tracker(const vehicle::Model& model, const Options& options = {}, SolverFactory make_solver = {});

  /// The command for now. @param now measured state; entries that are not numbers are a failure like any
  /// other  @param reference horizon + 1 samples `step` apart, the first at now + dead_time
  Command step(const State& now, std::span<const Sample> reference);
  /// The same, with the reference taken from a trajectory. @param t on its clock, s
  Command step(const State& now, const traj::RobotTrajectory& trajectory, double t);
  /// The inputs that act now, where they are measured: without it they follow from the commands.
  void observe(const Input& acting);
  /// Forgets the past. @param acting the inputs that act now
  void reset(const Input& acting = {});

  const Options& options() const { return options_; }
  /// Of the last step, for tests and logs.
  const optim::QpProblem& problem() const { return qp_.problem(); }
  const optim::QpSolver& solver() const { return *solver_; }

 private:
  bool solve(const Actuators::Outlook& from, std::span<const Sample> reference, Command& command);
  void keep_plan();
  Input fall_back(const Actuators::Outlook& from, Source& source);
  Input limited(const Input& wish, const Input& acting) const;

  vehicle::Model model_;
  Options options_;
  TrackingQp qp_;
  std::unique_ptr<optim::QpSolver> solver_;
  Actuators actuators_;
  std::vector<double> x_, y_;      // last solution and multipliers, moved on to now
  std::vector<Input> plan_;        // inputs of the last good plan, from the next step on
  std::vector<Sample> reference_;  // room for samples of a trajectory
  State believed_;                 // where the car should be when no measurement says so
  bool planned_ = false;
  int failures_ = 0;
};

}  // namespace seine::mpc
