#include "seine/geom/grid_check.hpp"

#include <cmath>
#include <cstddef>

namespace seine::geom {

bool is_complete(const OccupancyGrid& grid) {
  const Pose2& origin = grid.origin;
  return grid.width > 0 && grid.height > 0 && grid.resolution > 0.0 && std::isfinite(grid.resolution) &&
         std::isfinite(origin.x) && std::isfinite(origin.y) && std::isfinite(origin.heading) &&
         grid.occupied.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
}

}  // namespace seine::geom
