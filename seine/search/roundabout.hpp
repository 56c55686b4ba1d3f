#pragma once

#include <optional>
#include <vector>

#include "seine/search/motion.hpp"
#include "seine/search/path.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// A place where many straight ways cross: cars that all go round it the same way flow, cars that all go
/// through it queue.
struct Crossing {
  geom::Vec2 center;
  std::vector<int> robots;  ///< whose straight way from start to goal leads through it, ascending
};

/// The densest crossing of the team's straight ways, when it is crowded enough for a roundabout.
std::optional<Crossing> find_crossing(const world::Scenario& scenario);

/// Radius of a ring on which all robots of the crossing find room at once, m.
double ring_radius(const world::Scenario& scenario, const Crossing& crossing);

/// The robot's way by the ring: a tangent to it, counter-clockwise round it (keeping right), a tangent from
/// it to the goal. Nothing when the robot does not meet the ring that way or something stands there.
std::optional<Path> path_by_ring(const world::Scenario& scenario, const world::StaticMap& map, int robot,
                                 geom::Vec2 center, double radius);

}  // namespace seine::search
