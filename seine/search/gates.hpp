#pragma once

#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// A pose in a narrow place: the body in its middle and along it, heading the way the disc goes.
struct Gate {
  geom::Pose2 pose;
  double room = 0.0;  ///< m, of the footprint beyond the clearance, ≥ 0
};

/// The narrow places on a disc's way from `start` to `goal` (body poses), in their order: where the free
/// ground is hardly wider than the car, one gate for each such stretch. A lattice of moves does not meet a
/// door that leaves a hand's breadth, except by chance; from the middle of the door the ways to both sides
/// are easy.
/// @param to_go      of the disc around `reference` (body frame), to where that is at the goal
/// @param clearance  m, of the footprint to obstacles
/// @return empty when there is no way, no narrow place, or one that the footprint does not fit through
std::vector<Gate> gates_between(const world::StaticMap& map, const vehicle::Model& model, CostToGo& to_go,
                                const DiscWay& way, geom::Vec2 reference, const geom::Pose2& start,
                                const geom::Pose2& goal, double clearance);

}  // namespace seine::search
