#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/search/team_search.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

struct GuessOptions {
  Deadline deadline{};
  int threads = 1;
  std::uint64_t seed = 0;
  double extra_robot_clearance =
      0.0;  ///< m, wished for on top of the scenario's margin: a repair asks for more room
  const std::vector<std::optional<TimedPath>>* fixed =
      nullptr;  ///< robots that already have their motion and keep it (one entry a robot)
  const std::vector<std::vector<TimedPath>>* avoid =
      nullptr;  ///< per robot, guesses tried before that a repair should not repeat (may be empty)
  /// Whether a car by itself, or with a slow reverse gear, compares several ways by their time.
  bool quickest = true;
  bool explain = true;       ///< whether a no says why, which takes up to some tenths of a second
  Deadline explain_until{};  ///< for that: the search may have used up its own deadline
  LatticeOptions lattice{};  ///< how much of the limits the speed profiles use
  TeamSearchOptions team{};  ///< how much is tried
};

struct TeamGuess {
  bool complete = false;
  std::vector<TimedPath> robots;  ///< collision-free on the common clock when complete
  std::vector<double>
      alone;           ///< s, arrival of each car if the others were not there (lower bound on its path)
  std::string reason;  ///< why not complete: names the robots
  std::vector<int> without_way;     ///< robots that found no path even without the others
  std::vector<int> without_motion;  ///< robots that found one, but no motion among the others
  std::string meetings;             ///< what those would meet first on their ways: half sentences
  bool impossible = false;          ///< proved: no plan exists, another guess is of no use
  struct {
    double field = 0, paths = 0, coordinate = 0;
  } seconds;
  double extra_robot_clearance = 0.0;  ///< m, what was kept of the wish: all, half, or nothing of it
  TeamSearch::Effort effort;           ///< of the coordination
};

/// The coordinated guess for the whole team: who drives where, when, and who goes first
/// (docs/front-end-coordination.md). Anytime after the first complete pass; deterministic for the same seed
/// when the deadline is not reached.
TeamGuess guess_team(const world::Scenario& scenario, const world::StaticMap& map,
                     const GuessOptions& options);

}  // namespace seine::search
