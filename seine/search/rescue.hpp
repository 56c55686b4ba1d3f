#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/coordinator.hpp"
#include "seine/search/space_time_planner.hpp"

namespace seine::search {

/// A few cars in a narrow place, or among moving obstacles, that velocity planning on fixed ways could not
/// bring through: one after the other, each by a space-time search among those before it, in every order. The
/// first car may also leave late, which gives the others the time to make way.
class Rescue {
 public:
  using Placed = std::shared_ptr<const Placement>;
  /// A motion among the others of `state`, found by a space-time search when that is better than `best`.
  using Among = std::function<Placed(int robot, const TeamState& state, Placed best, int patience)>;

  Rescue(const Coordinator& coordinator, Among among, CoordinatorWorkspace& workspace)
      : coordinator_(coordinator), among_(std::move(among)), workspace_(workspace) {}

  /// How patient the searches are, in rounds: the first makes do with the ways at hand.
  struct Rounds {
    int first, last;
  };
  static constexpr Rounds by_ways() { return {kNoSearch, kNoSearch}; }
  static constexpr Rounds all() { return {kNoSearch, SpaceTimePlanner::kMostPatience}; }

  /// Gives the cars of `group` (few) new motions among the others of `state`, which keep theirs. False: not
  /// found, `state` as it was.
  bool run(std::span<const int> group, TeamState& state, const Deadline& deadline, Rounds rounds = all());

 private:
  static constexpr int kNoSearch = -1;

  bool attempt(const std::vector<int>& order, double delay, int patience, TeamState& state);
  TeamState best_of_orders(std::vector<int> order, double delay, int patience, const TeamState& without,
                           const Deadline& deadline);
  std::vector<double> delays(const std::vector<int>& order, int patience) const;
  void settle(const std::vector<int>& order, TeamState& state);

  const Coordinator& coordinator_;
  Among among_;
  CoordinatorWorkspace& workspace_;
};

}  // namespace seine::search
