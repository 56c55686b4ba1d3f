#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seine/sim/car.hpp"
#include "seine/sim/replanning.hpp"
#include "seine/sim/simulation.hpp"

namespace seine::sim {

/// Decides which plan the team follows and how fast its clock runs: asks for better plans while targets are
/// in the air, and stops the team when it can no longer rely on a car.
class Conductor {
 public:
  /// @param start s, when it begins to be called
  Conductor(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
            const SimulationOptions& options, double start);

  /// To be called every control period, before the cars are told what to do.
  void decide(double time, std::span<const Car> cars, const std::vector<net::Target>& in_the_air);
  void advance(double duration);

  const traj::TeamTrajectory& plan() const { return plan_; }
  const PlanClock& clock() const { return clock_; }
  double end() const { return begin_ + plan_.makespan() + waited_; }  ///< s, of the plan
  bool stopping() const { return stopping_; }
  int adopted() const { return adopted_; }
  int asked() const { return asked_; }
  int late() const { return late_; }
  /// What was decided since the last call, a sentence each.
  std::vector<std::string> news();

 private:
  struct Candidate {
    double begin = 0.0;  // s
    Replanned answer;
    bool late = false;
  };

  void keep_together(double time, std::span<const Car> cars);
  std::optional<std::string> reason_to_stop(double time, std::span<const Car> cars);
  bool time_to_ask(double time, const std::vector<net::Target>& in_the_air) const;
  void ask(double time, const std::vector<net::Target>& in_the_air);
  void weigh(double time, const std::vector<net::Target>& in_the_air);
  std::string name(std::size_t robot) const;

  const world::Scenario& scenario_;
  const SimulationOptions& options_;
  traj::TeamTrajectory plan_;
  double begin_ = 0.0;  // s, when the plan's clock was 0
  PlanClock clock_;
  double waited_ = 0.0;     // s, for cars that fell behind
  double free_from_ = 0.0;  // s, from when on nothing but the team itself hangs on the plan's clock
  bool stopping_ = false;
  std::optional<std::size_t> silent_;  // the car that does not answer
  std::optional<Candidate> candidate_;
  bool was_late_ = false;  // the last answer
  double next_ask_ = 0.0;  // s
  int adopted_ = 0, asked_ = 0, late_ = 0;
  std::vector<std::string> news_;
};

}  // namespace seine::sim
