#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "seine/sim/car_plant.hpp"
#include "seine/sim/catch_watch.hpp"
#include "seine/sim/escort.hpp"
#include "seine/sim/noise.hpp"
#include "seine/sim/plan_clock.hpp"
#include "seine/sim/recorder.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::sim {

inline constexpr double kTick = 1e-3;           ///< s: plants, net and targets
inline constexpr double kControlPeriod = 0.05;  ///< s
inline constexpr double kRecordPeriod = 0.01;   ///< s
/// Controllers of a team at rest run so long before the plan begins: what acts late must be told early.
inline constexpr double kCountdown = 0.3;  ///< s

/// What a car has to do from now on: its way, and the clock to follow it by.
struct Reference {
  const traj::RobotTrajectory& way;
  PlanClock clock;
  std::optional<Escort> escort{};  ///< where it goes with a car that does not answer

  /// What it should do `ahead` seconds from now.
  traj::State at(double ahead) const {
    return escort ? escort->state_on(way, clock, ahead) : clock.ahead(ahead).state_on(way);
  }
};

/// What a controller wants of its car.
struct Control {
  Command command;
  bool failed = false;  ///< it could not compute what it wanted, and falls back on this
};
/// Drives one car: called every kControlPeriod for each with where the car believes to be when the command
/// will take effect, and the reference from then on. `fails`: its computation is made to fail.
using Controller =
    std::function<Control(std::size_t robot, const CarState& now, const Reference& reference, bool fails)>;

/// The question a replanner is asked.
struct Situation {
  /// The task as it will stand when the new plan begins: cars where the old plan has them then, targets as
  /// they are seen now. Its clock starts then.
  world::Scenario scenario;
  const traj::TeamTrajectory& plan;  ///< that the team follows now …
  double plan_time = 0.0;            ///< s, … and where on its clock the new one begins
  double deadline = 0.0;             ///< s of wall time for an answer
};
struct Replanned {
  bool certified = false;
  traj::TeamTrajectory plan;
  double seconds = 0.0;  ///< wall time it took
};
using Replanner = std::function<Replanned(const Situation&)>;

/// What goes wrong on purpose. Times in s.
struct Faults {
  struct LostFix {
    std::size_t robot;
    double from, duration;
  };
  struct FailedControl {
    std::size_t robot;
    double at, duration;
  };
  struct LateReplan {
    double from, duration;
  };
  struct TargetJump {
    std::size_t target;
    double from, duration;
    geom::Vec3 shift;  ///< m, of what is seen of it
  };
  struct Breakdown {
    std::size_t robot;
    double at;
  };
  std::vector<LostFix> lost_fixes;
  std::vector<FailedControl> failed_controls;
  std::vector<LateReplan> late_replans;
  std::vector<TargetJump> target_jumps;
  std::vector<Breakdown> breakdowns;
};

struct SimulationOptions {
  Noise noise;
  std::uint64_t seed = 0;
  Faults faults;
  Replanner replanner;                        ///< none: the team keeps its plan
  double replan_period = 0.1;                 ///< s
  double replan_deadline = 0.05;              ///< s
  Recorder* recorder = nullptr;               ///< gets every signal
  std::function<void(double part)> progress;  ///< optional; 0 … 1, every kRecordPeriod
};

/// What became of one target (or of the payload).
struct Outcome {
  Fate fate = Fate::flying;
  bool delivered = false;      ///< at rest in the net at the end, with the team where it belongs
  double crossing_time = 0.0;  ///< s, through the rim
  double catch_time = 0.0;     ///< s, at rest
  double lowest = 0.0;         ///< m above the ground, of its bottom
};

struct SimulationResult {
  bool caught = false;            ///< every target; true when there is none
  bool delivered = false;         ///< every target and the payload; without a net: every car at its goal
  bool stopped = false;           ///< the team gave up its plan and stands
  std::vector<Outcome> outcomes;  ///< targets in their order, or the payload
  double tracking_rms = 0.0;      ///< m, rear axle to reference, all cars, until the plan's end
  double tracking_worst = 0.0;    ///< m
  double min_clearance = 0.0;     ///< m, of footprints to each other and to obstacles
  double worst_stretch = 0.0;     ///< largest |a_i − a_j| / |r_i − r_j|
  double goal_error = 0.0;  ///< m, farthest car from its goal, or the net's middle from the delivery's rim
  int replans = 0;          ///< plans adopted on the way
  int replans_asked = 0, replans_late = 0;
  double duration = 0.0;          ///< s, simulated
  double real_time_factor = 0.0;  ///< simulated / wall time
  std::vector<Note> notes;        ///< what happened, in order

  /// Everything that was asked for, with nothing broken on the way.
  bool done() const { return caught && delivered && min_clearance > 0.0 && worst_stretch <= 1.0; }
};

/// Lets the team drive `plan` in the world of `scenario`, with sensors, delays and physics. `plan` is trusted
/// to be certified. Throws InputError for a plan of another team, a missing controller, or numbers that make
/// no sense. The same for the same seed, as long as controller and replanner are.
SimulationResult simulate(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                          const Controller& controller, const SimulationOptions& options = {});

}  // namespace seine::sim
