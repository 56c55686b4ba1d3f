#pragma once

#include <limits>
#include <string>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::certify {

/// Cars of a team that delivers with a heading end within this of it, rad.
inline constexpr double kDeliveryHeading = 0.1;

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
  net_stretch,   ///< two attachments are further apart than the cloth allows
  net_topology,  ///< the ring is not convex and counter-clockwise with its margin
  net_opening,   ///< soon after a catch the net is not wide open
  net_holding,   ///< what lies in the net can roll out over an edge
  net_drag,      ///< the net's lowest point comes too near the ground
  net_obstacle,  ///< something too tall to pass under lies inside the net
  target_catch,  ///< a target misses the net, or the net cannot hold it ("catch")
  braking,       ///< a car brakes or accelerates too hard for what lies in the net
  carrying,      ///< a car drives so fast that the air may blow what lies in the net out of it
  delivery,      ///< the team does not come to rest where it must
  undecided,     ///< the proof ran out of its deadline or its depth: no proof, and no refutation
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

/// What is left of a net's limits where least is left; below 0 where they are broken.
struct NetRoom {
  Closest stretch;    ///< m, of a pair's largest distance (resolved to 5 mm)
  Closest convexity;  ///< m, of an attachment's distance inside a ring edge, beyond net::kConvexMargin (5 mm)
  Closest ground;     ///< m, of the lowest point's height, beyond the net's clearance (1 cm)
  /// m, to obstacles: the distance beside them, or the height above them beyond the net's clearance, whatever
  /// is larger (1 cm, searched up to 0.2 m)
  Closest obstacles;
  /// m², net::holding_reserve while something lies in the net (0.01 m²).
  Closest holding;
};

enum class Verdict {
  holds,      ///< proved
  refuted,    ///< something is broken, and `violations` says what
  undecided,  ///< neither: time or depth ran out, and nothing broken was met until then
};
/// "certified", "refuted" or "undecided".
const char* name_of(Verdict verdict);

/// The verdict on one plan.
struct Certificate {
  bool holds = false;
  std::vector<Violation> violations;  ///< the worst of each kind and robot (or pair), by time
  Closest robots;                     ///< footprint to footprint (resolved to 1 mm)
  Closest obstacles;  ///< footprint to static and moving obstacles and bounds (searched up to 1 m)
  NetRoom net;        ///< infinite without a net
  std::vector<net::Catch> catches;  ///< one a target, in their order; NaN where it is never in reach
  double seconds = 0.0;             ///< wall time of the proof

  Verdict verdict() const;
};

struct Options {
  int threads = 1;
  Deadline deadline;
  int violations_per_kind = 1;  ///< how many instants of the same break are listed
};

/// Proves in continuous time that `plan` keeps everything the scenario asks, or says what it breaks. Never
/// throws on a bad plan: that is a verdict; a scenario whose numbers make no sense throws
/// world::Unsound. The result does not depend on the number of threads.
Certificate certify(const world::Scenario& scenario, const world::StaticMap& map,
                    const traj::TeamTrajectory& plan, const Options& options = {});

}  // namespace seine::certify
