#pragma once

#include <span>
#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/path.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {

/// A way as arcs one after the other: what the search finds and smoothing improves, before it is sampled into
/// a Path.
struct Route {
  geom::Pose2 start;
  geom::Pose2 goal;
  std::vector<vehicle::Arc> arcs;
  bool wriggles = false;  ///< see Path
};

/// What a route costs, in metres driven forwards on free ground.
struct RouteCosts {
  vehicle::DrivingCosts driving;
  double radius = 1.0;           ///< m, of the tightest turn: the unit of curvature changes
  double steering_change = 0.0;  ///< m, from straight to the tightest turn
  double short_stretch =
      0.0;  ///< m: a stretch in one gear shorter than this costs up to two more gear changes
  std::span<const Bump> bumps;

  /// @param before  the arc driven before (its gear and curvature), or null at a start from rest
  double of(const geom::Pose2& from, std::span<const vehicle::Arc> arcs,
            const vehicle::Arc* before = nullptr) const;
  /// The bumps' part of it for one arc.
  double bumps_along(const geom::Pose2& from, const vehicle::Arc& arc) const;
  /// Of one arc after another, without bumps and short stretches.
  double step(const vehicle::Arc& arc, const vehicle::Arc* before) const;
};

/// room(end) when every arc is clear, negative otherwise.
double sweep(const FootprintChecker& checker, const geom::Pose2& from, double room_from,
             std::span<const vehicle::Arc> arcs);

/// Replaces parts of the route by cheaper Reeds-Shepp words that are clear: wiggles and needless gear changes
/// go. Never costlier.
void shorten(Route& route, const FootprintChecker& checker, const RouteCosts& costs);

/// Neighbouring arcs of equal curvature and gear become one, arcs of no length vanish.
void merge(std::vector<vehicle::Arc>& arcs);

/// Points at most `spacing` m apart; the last one stands exactly on the route's goal.
Path sampled(const Route& route, double spacing);

/// The same way driven from its goal to its start.
Route reversed(const Route& route);

}  // namespace seine::search
