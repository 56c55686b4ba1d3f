#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "seine/base/workers.hpp"
#include "seine/planner/attempts.hpp"
#include "seine/planner/planner.hpp"
#include "seine/planner/segment_fit.hpp"
#include "seine/planner/slower.hpp"
#include "seine/search/team_guess.hpp"
#include "seine/trajopt/joint_problem.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// One call of plan(): guess, optimisation, certificate, and repair of what the certificate refuses
/// (docs/optimiser.md). Internal to the room.
///
/// The optimisation goes from the independent to the joint: every car alone among the others' guesses; then
/// the groups of cars that come close to each other, each group jointly; then whatever the certificate finds
/// fault with, jointly again with more asked of it.
class Session {
 public:
  Session(const world::Scenario& scenario, const Options& options);
  PlanResult run();

 private:
  using Group = std::vector<int>;  // robots, ascending
  enum class Start {
    guess,         // from the guess, soft constraints first
    gentle_guess,  // from the guess, stiff at once: stays closer to it, in its passing orders
    solution,      // from where the cars are now, stiff
  };

  void climb();
  bool have_guess(const Attempt& now);
  bool guessed_for(const Attempt& now) const;
  bool guess(std::uint64_t attempt);
  std::string late_reason() const;
  void prepare(const Attempt& now);
  void place_bodies();
  void optimise(bool gently);
  void solve_groups(const std::vector<Group>& groups, Start start);
  void solve(const Group& group, Start start, Workers& workers);
  trajopt::Task task_for(const Group& group) const;
  std::vector<Group> close_groups(double gap) const;
  std::vector<Group> movers(std::vector<Group> groups) const;
  bool certify();
  void keep_nearest();
  void slow_down();
  void stop_and_steer();
  void settle();
  std::string reason_to_give_up() const;
  void polish(int rounds);
  void polish_briefly();
  bool wriggles() const;
  std::vector<Group> raise_demands(int round);
  double& extra(std::size_t robot, std::size_t body) { return extra_[robot * bodies_.size() + body]; }
  void report(const char* stage, double fraction) const;
  PlanResult finish();

  const world::Scenario& scenario_;
  const Options& options_;
  Stopwatch watch_;
  Deadline deadline_;
  Workers workers_;
  world::StaticMap map_;
  world::Scenario asked_;  // the question with the margins of the attempt at hand
  trajopt::Settings settings_;
  search::TeamGuess guess_;
  bool explained_ = false;  // why there is no guess

  trajopt::Units units_;
  double tick_ = 0.05;  // s
  int ticks_ = 1;
  std::vector<trajopt::RobotTask> tasks_;
  std::vector<std::optional<traj::RobotTrajectory>> given_;  // per robot: its way where none is optimised
  std::vector<std::vector<double>> solution_;                // per robot: the optimiser's variables
  std::vector<int> fault_rounds_;         // per robot: rounds in a row in which the certificate blamed it
  std::vector<int> evaluations_;          // per robot: of the last group it was solved in
  std::vector<trajopt::Body> bodies_;     // every robot as it moves now, then the moving obstacles' parts
  std::vector<double> extra_;             // m, robots × bodies: clearance asked on top of the scenario's
  std::vector<trajopt::Demand> demands_;  // per robot
  PlanResult result_;

  int attempts_ = 0;                                          // from a guess to a certificate
  std::optional<Attempt> guessed_;                            // what guess_ belongs to
  double nearest_ = std::numeric_limits<double>::infinity();  // severity of the plan that came nearest …
  std::string fault_;                                         // … and what the certificate said of it
  std::optional<Slowed> slowable_;  // of the attempt at hand: over its limits only, with its certificate
  double slowable_end_ = 0.0;       // s, its end when it is slowed
  std::optional<Slowed> slowed_;    // certified
  double slowed_by_ = 1.0;
};

}  // namespace seine::planner
