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

/// Whether backwards is so much slower than forwards that a way of fewer metres backwards may be the quicker.
bool slow_reverse(const vehicle::Limits& limits);

/// A place that costs extra to drive through: `weight` (metres of path per metre driven there) at its center,
/// fading to 0 at its edge.
struct Bump {
  geom::Vec2 center;
  double radius = 1.0;
  double weight = 2.5;
};

struct PathOptions {
  int max_expansions = 20000;
  double heuristic_weight = 1.3;
  /// m, certified margin to static obstacles; the planner adds its own slack where it can.
  double clearance = 0.05;
  /// Detours.
  std::span<const Bump> bumps;
  /// Convex footprints in the world that are obstacles too (other cars at their start or goal). Those nearer
  /// than `parked_clearance` (m) to the own start or goal do not count.
  std::span<const std::vector<geom::Vec2>> parked;
  double parked_clearance = 0.05;
  /// Whether several ways are compared by the time they take (a millisecond or so); else the first is good
  /// enough.
  bool quickest = false;
  Deadline deadline;
};

/// Paths for one kind of car on one map: Hybrid A* with Reeds-Shepp shots, whole footprint, forward and,
/// where the car's reverse speed is not 0, reverse. Heuristics are cached per goal region. `plan` may be
/// called from many threads at once.
class PathPlanner {
 public:
  PathPlanner(const world::StaticMap& map, const vehicle::Model& model);
  ~PathPlanner();
  PathPlanner(PathPlanner&&) noexcept;

  /// The path from start to goal, or nothing when none was found within the limits. Deterministic. Curvatures
  /// are at most κ_max, as a rule at most κ_max / 1.1. A start that is the goal gives a path of one point.
  std::optional<Path> plan(const geom::Pose2& start, const geom::Pose2& goal,
                           const PathOptions& options) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seine::search
