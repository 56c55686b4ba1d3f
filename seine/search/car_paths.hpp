#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seine/search/path_planner.hpp"
#include "seine/search/space_time_planner.hpp"
#include "seine/search/team_guess.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {

/// How one car of the team gets from its start to its goal, the others being anything from absent to timed
/// traffic: out of the margin first where it starts inside it, braking first where it is moving and must.
class CarPaths {
 public:
  /// All three must outlive it.
  CarPaths(const world::Scenario& scenario, const world::StaticMap& map, const GuessOptions& options);

  /// The way that is tried first. A car by itself takes the quickest of a few where it has to change gear,
  /// and another with another seed. Safe to call from several threads.
  std::optional<Path> first(int robot) const;
  /// A way that avoids bumps where it can, and parked cars (footprints in the world). Likewise safe.
  std::optional<Path> around(int robot, std::span<const Bump> bumps,
                             std::span<const std::vector<geom::Vec2>> parked, int expansions) const;
  /// A way with its waits among moving traffic; none for a car that is moving. One thread at a time.
  std::optional<Path> among(int robot, std::span<const Traffic> traffic,
                            const TeamSearch::Sources::Among& how);

  /// One for each model.
  const std::vector<PathPlanner>& planners() const { return planners_; }

 private:
  std::optional<Path> from(const world::Robot& who, const geom::Pose2& start,
                           const PathOptions& options) const;
  std::optional<Path> out_of_margin(const world::Robot& who, const PathOptions& options) const;

  const world::Scenario& scenario_;
  const world::StaticMap& map_;
  const GuessOptions& options_;
  std::vector<PathPlanner> planners_;                     // one for each model
  std::vector<std::unique_ptr<SpaceTimePlanner>> among_;  // likewise, made when first needed
};

}  // namespace seine::search
