#pragma once

#include <optional>
#include <vector>

#include "seine/base/workers.hpp"
#include "seine/planner/planner.hpp"
#include "seine/planner/segment_fit.hpp"
#include "seine/search/team_guess.hpp"
#include "seine/trajopt/joint_problem.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// One call of plan(): guess, joint optimisation, certificate, and repair of what the certificate refuses. Internal to the room.
class Session {
 public:
  Session(const world::Scenario& scenario, const Options& options);
  PlanResult run();

 private:
  /// What is asked of the cars beyond the scenario, raised where the certificate found fault.
  struct Demands {
    std::vector<double> penalty_scale;   ///< per robot
    std::vector<double> pair_extra;      ///< m, robots × robots
    std::vector<double> obstacle_extra;  ///< m, per robot
  };

  bool guess(std::uint64_t attempt);
  void prepare();
  void solve(const std::vector<int>& robots, bool from_guess);
  trajopt::Task task_for(const std::vector<int>& robots) const;
  bool certify();
  void polish();
  std::vector<int> raise_demands();
  void report(const char* stage, double fraction) const;
  PlanResult finish();

  const world::Scenario& scenario_;
  const Options& options_;
  Stopwatch watch_;
  Deadline deadline_;
  Workers workers_;
  world::StaticMap map_;
  search::TeamGuess guess_;
  std::vector<trajopt::RobotTask> tasks_;
  std::vector<std::vector<double>> solution_;  // per robot: the optimiser's variables
  Demands demands_;
  trajopt::Units units_;
  double tick_ = 0.05;  // s
  int ticks_ = 1;
  PlanResult result_;
};

}  // namespace seine::planner
