#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "seine/base/workers.hpp"
#include "seine/planner/formation_guess.hpp"
#include "seine/planner/net_question.hpp"
#include "seine/planner/planner.hpp"
#include "seine/trajopt/joint_problem.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// One call of plan() for a team with a net: what is asked, a guess for the formation, one joint
/// optimisation with a common timing, certificate, and repair of what the certificate refuses
/// (docs/net-planning.md). Internal to the room.
class NetSession {
 public:
  NetSession(const world::Scenario& scenario, const Options& options);
  PlanResult run();

 private:
  bool stand();
  bool go_on();
  bool drive_slower();
  void guess_and_solve();
  bool solve_guess(int rounds);
  void keep_nearest();
  bool guess(FormationGuesser& guesser, int attempt);
  void prepare();
  void solve(bool soft);
  bool certify();
  void polish(int rounds);
  void raise_demands();
  void raise_catch(std::size_t target);
  void report(const char* stage, double fraction) const;
  PlanResult finish();

  const world::Scenario& scenario_;
  const Options& options_;
  Stopwatch watch_;
  Deadline deadline_;
  Workers workers_;
  world::StaticMap map_;
  NetQuestion question_;
  trajopt::NetTask net_;  // what is asked of the present attempt, raised where the certificate found fault
  trajopt::Settings settings_;
  FormationGuess guess_;
  trajopt::Units units_;
  double tick_ = 0.05;  // s
  int ticks_ = 1;
  std::vector<trajopt::RobotTask> tasks_;
  std::vector<trajopt::Body> bodies_;  // moving obstacles
  std::vector<double> extra_;          // m, robots × (robots + bodies)
  std::vector<trajopt::Demand> demands_;
  std::vector<double> x_;
  std::optional<std::pair<traj::TeamTrajectory, certify::Certificate>> stay_;  // certified, without reserve
  PlanResult result_;
  bool insisting_ = false;                                    // attempts that missed by little once more
  double nearest_ = std::numeric_limits<double>::infinity();  // severity of the plan that came nearest …
  std::string fault_;                                         // … and what the certificate said of it
};

}  // namespace seine::planner
