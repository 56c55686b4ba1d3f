#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/search/path.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Points of a planned path are at most this many car lengths apart.
inline constexpr double kPathSpacing = 0.06;

/// A place that costs extra to drive through: `weight` (s per metre-equivalent, added to the path length) inside `radius`, fading to 0 at its edge.
struct Bump {
  geom::Vec2 center;
  double radius = 1.0;
  double weight = 2.5;
};

struct PathOptions {
  int max_expansions = 20000;
  double heuristic_weight = 1.3;
  double clearance = 0.05;                     ///< m, certified margin to static obstacles; the planner adds its own slack where it can
  std::span<const Bump> bumps;                 ///< detours
  std::span<const std::vector<geom::Vec2>> parked;  ///< convex footprints in the world that are obstacles too (other cars at their start or goal)
  double parked_clearance = 0.05;              ///< m
  Deadline deadline;
};

/// Paths for one kind of car on one map: Hybrid A* with Reeds-Shepp shots, whole footprint, forward and reverse. Heuristics are cached per
/// goal region. `plan` may be called from many threads at once.
class PathPlanner {
 public:
  PathPlanner(const world::StaticMap& map, const vehicle::Model& model);
  ~PathPlanner();
  PathPlanner(PathPlanner&&) noexcept;

  /// The path from start to goal, or nothing when none was found within the limits. Deterministic.
  std::optional<Path> plan(const geom::Pose2& start, const geom::Pose2& goal, const PathOptions& options) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seine::search
