#pragma once

#include <optional>

#include "seine/base/deadline.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"

namespace seine::search {

/// How finely Hybrid A* [Dolgov10] looks. Lengths in metres; docs/front-end-paths.md has the measurements
/// behind the numbers.
struct LatticeSettings {
  double step = 0.8;      ///< m driven per move
  double min_step = 0.8;  ///< m: a move that is blocked is tried at half its length, and so on down to this
  double cell = 0.45;     ///< m, side of a position bin
  /// Moves end where they are blocked instead, and moves of a quarter and a sixteenth of `step` are tried
  /// too.
  bool until_blocked = false;
  bool gears_apart = false;  ///< whether arriving forwards and arriving backwards are different bins
  int headings = 24;         ///< heading bins
  int forward = 5;           ///< curvatures tried forwards (odd)
  int backward = 3;          ///< and backwards
  double heuristic_weight = 1.3;
  int max_expansions = 2000;
};

/// What a search works with.
struct LatticeProblem {
  geom::Pose2 start;
  geom::Pose2 goal;
  const FootprintChecker* checker = nullptr;
  CostToGo* to_go = nullptr;  ///< of the disc around `reference`, to where that is at the goal
  geom::Vec2 reference;       ///< body frame
  RouteCosts costs;           ///< costs.radius is the turning radius used
  Deadline deadline;
};

struct LatticeResult {
  std::optional<Route> route;
  int expansions = 0;
  bool exhausted =
      false;  ///< every node that can be reached was looked at: moves are too long, or there is no way
  bool unreachable = false;  ///< proved: not even a disc inside the footprint has a way
};

/// Hybrid A* with a Reeds-Shepp shot from every expanded node. Deterministic; ties go to the node made first.
LatticeResult search_lattice(const LatticeProblem& problem, const LatticeSettings& settings);

}  // namespace seine::search
