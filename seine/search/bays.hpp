#pragma once

#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/search/path.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Two cars in a place where they cannot pass each other everywhere.
struct BayQuestion {
  const world::StaticMap* map;
  const vehicle::Model* model;        ///< of the car that makes way
  const Path* way;                    ///< its own
  const vehicle::Model* other_model;  ///< of the car that comes through
  const Path* other;                  ///< the other's way
  double obstacle_clearance = 0.0;    ///< m
  double robot_clearance = 0.0;       ///< m
};

/// Places beside a car's way where it can stand while the other drives through on its own way: along the way,
/// with room on both sides. A few of them, apart from each other; those in the middle of a stretch of
/// such places first come from either side of the way.
std::vector<geom::Pose2> bays_beside(const BayQuestion& question);

}  // namespace seine::search
