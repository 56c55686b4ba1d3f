#pragma once

#include <cmath>

#include "seine/geom/grid.hpp"

namespace seine::geom {

/// Whether a place in the world lies in a blocked cell; beyond the grid none does.
inline bool is_blocked(const OccupancyGrid& grid, Vec2 place) {
  const Vec2 along = grid.origin.direction(), from = place - grid.origin.position();
  const double column = std::floor(dot(along, from) / grid.resolution);
  const double row = std::floor(cross(along, from) / grid.resolution);
  if (!(column >= 0.0 && row >= 0.0 && column < grid.width && row < grid.height)) return false;
  return grid.blocked(static_cast<int>(column), static_cast<int>(row));
}

}  // namespace seine::geom
