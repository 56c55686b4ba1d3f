#pragma once

#include <limits>
#include <string>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::certify {

/// What a plan can break.
enum class Kind {
  malformed,  ///< not a trajectory at all: sizes, NaN, non-positive durations, wrong number of robots
  start,
  goal,
  continuity,
  rest,
  gear,
  speed,
  reverse_speed,
  acceleration,
  lateral_acceleration,
  curvature,
  steering_rate,
  robot_clearance,
  obstacle_clearance,
  moving_obstacle_clearance,
  bounds,
  undecided,  ///< the proof ran out of its deadline or its depth: counted as broken
};
const char* name_of(Kind kind);

struct Violation {
  Kind kind;
  double time = 0.0;  ///< s, an instant at which it is broken
  int robot = -1;
  int other = -1;      ///< the other robot, or the static piece / moving obstacle, where there is one
  double value = 0.0;  ///< what was found …
  double limit = 0.0;  ///< … and what is allowed
  std::string text;    ///< one sentence with names and numbers
};

/// The smallest distance met, and where.
struct Closest {
  double clearance = std::numeric_limits<double>::infinity();  ///< m
  double time = 0.0;
  int robot = -1;
  int other = -1;
};

/// The verdict on one plan.
struct Certificate {
  bool holds = false;
  std::vector<Violation> violations;  ///< the worst of each kind and robot (or pair), by time
  Closest robots;                     ///< footprint to footprint (resolved to 1 mm)
  Closest obstacles;     ///< footprint to static and moving obstacles and bounds (searched up to 1 m)
  double seconds = 0.0;  ///< wall time of the proof
};

struct Options {
  int threads = 1;
  Deadline deadline;
  int violations_per_kind = 1;  ///< how many instants of the same break are listed
};

/// Proves in continuous time that `plan` keeps everything the scenario asks, or says what it breaks. Never
/// throws on a bad plan: that is a verdict. The result does not depend on the number of threads.
Certificate certify(const world::Scenario& scenario, const world::StaticMap& map,
                    const traj::TeamTrajectory& plan, const Options& options = {});

}  // namespace seine::certify
