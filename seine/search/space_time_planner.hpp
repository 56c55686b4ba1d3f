#pragma once

#include <optional>
#include <span>

#include "seine/base/deadline.hpp"
#include "seine/search/cost_to_go_cache.hpp"
#include "seine/search/path.hpp"
#include "seine/search/space_time_search.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

struct SpaceTimeOptions {
  double clearance = 0.05;  ///< m, certified margin to static obstacles
  double extra = 0.0;  ///< m, wished for on top of the traffic's clearance, where the ends leave that much
  double pace = 0.7;   ///< of the grid's speeds: what the car is assumed to drive at
  int patience = 0;    ///< 0 to kMostPatience: how long to look
  bool hurry = false;  ///< rather go far around than wait long
  Deadline deadline;
};

/// Paths for one kind of car among traffic whose motion is known (docs/front-end-coordination.md): space-time
/// searches, from coarse to fine. For one thread.
class SpaceTimePlanner {
 public:
  SpaceTimePlanner(const world::StaticMap& map, const vehicle::Model& model, const SpeedGrid& grid);

  static constexpr int kMostPatience = 3;
  /// A path that can be driven in time among the traffic, or nothing when none was found.
  std::optional<Path> plan(const geom::Pose2& start, const geom::Pose2& goal,
                           std::span<const Traffic> traffic, const SpaceTimeOptions& options);
  /// Expansions of all searches so far.
  int expansions() const { return expansions_; }

 private:
  std::vector<Traffic> with_extra(const geom::Pose2& start, const geom::Pose2& goal,
                                  std::span<const Traffic> traffic, double extra) const;

  const world::StaticMap& map_;
  vehicle::Model model_;
  SpeedGrid grid_;
  PointDistances distances_;
  DiscCover cover_;
  SweptFootprint footprint_;
  CostToGoCache cache_;
  int expansions_ = 0;
};

}  // namespace seine::search
