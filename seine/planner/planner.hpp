#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "seine/certify/certificate.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::planner {

/// Reported now and then while planning; called from the planning thread.
struct Progress {
  const char* stage = "";  ///< "guess", "optimise", "certify", "repair"
  double fraction = 0.0;   ///< of the stage, 0 … 1
};

/// Parts of the method switched off, to see what each brings (the supplement's ablations [Pei24]). The
/// certificate still asks for everything.
struct Ablation {
  bool catching = false;    ///< nothing pulls the team to its targets
  bool size = false;        ///< the net may stretch and drag
  bool topology = false;    ///< the ring may fold
  bool relaxation = false;  ///< end poses stay where the guess has them
  bool cusps = false;       ///< so do gear changes
};

struct Options {
  double deadline_s = std::numeric_limits<double>::infinity();  ///< wall time for everything
  int threads = 0;                                              ///< 0: as many as the machine has
  std::uint64_t seed = 0;
  /// Once it is true planning ends as at its deadline, with the best certified plan so far. It must outlive
  /// the call. Optional.
  const std::atomic<bool>* cancelled = nullptr;
  Ablation without;
  std::function<void(const Progress&)> progress;  ///< optional
  /// A team with a net can go on from a plan it has: planning starts from what is left of that plan at
  /// `previous_time` on its clock, which is 0 on the new one. The plan must outlive the call.
  const traj::TeamTrajectory* previous = nullptr;
  double previous_time = 0.0;  ///< s
};

/// Where the time went, seconds.
struct Times {
  double compute = 0.0;  ///< from the parsed scenario to the certified plan
  double guess = 0.0;
  double corridor = 0.0;
  double optimise = 0.0;
  double certify = 0.0;
};

/// What a plan costs.
struct Quality {
  double makespan = 0.0;           ///< s
  double mean_travel = 0.0;        ///< s, mean over robots of their own arrival times
  double distance = 0.0;           ///< m, Σ_k ∫ |σ̇| dt
  double acceleration_cost = 0.0;  ///< m²/s³, Σ_k ∫ (a_t² + a_n²) dt
  int gear_changes = 0;            ///< of all robots
};

struct PlanResult {
  bool certified = false;
  std::string reason = "not run";  ///< empty when certified
  bool impossible = false;         ///< proved: the task has no plan, and `reason` says why
  /// Whether a published method calls itself successful, whatever the certificate says; absent for ours.
  std::optional<bool> claimed;
  traj::TeamTrajectory plan;  ///< only meaningful when certified or claimed
  certify::Certificate certificate;
  Quality quality;
  Times times;
  int iterations = 0;  ///< objective evaluations, all rounds
  int repairs = 0;     ///< rounds of re-guessing after the first
};

/// Plans for the whole team. An impossible or unsolved task is a result with a reason; a scenario that is
/// wrong in itself (a start in collision, two goals that overlap) throws InputError, and so do options that
/// make no sense: a deadline that is not a number, a previous plan of another team.
PlanResult plan(const world::Scenario& scenario, const Options& options = {});

Quality measure(const traj::TeamTrajectory& plan);

}  // namespace seine::planner
