#pragma once

#include <span>
#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::sim {

/// How near footprints come to each other and to everything else.
class Surroundings {
 public:
  explicit Surroundings(const world::Scenario& scenario);

  /// The least distance, m, of the team's footprints at these poses to each other, to obstacles and bounds;
  /// negative where they overlap. No more than kFarEnough.
  double clearance(double time, std::span<const geom::Pose2> poses) const;

  static constexpr double kFarEnough = 1.0;  ///< m

 private:
  struct Mover {
    std::vector<geom::Convex> parts;  // in its frame
    const std::vector<world::Waypoint>& motion;
  };
  double to_movers(double time, const geom::Convex& car) const;

  const world::Scenario& scenario_;
  world::StaticMap map_;
  std::vector<Mover> movers_;
};

/// Where a moving obstacle is.
geom::Pose2 pose_at(std::span<const world::Waypoint> motion, double time);

}  // namespace seine::sim
