#pragma once

#include <cstdint>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/geom/pose2.hpp"

namespace seine::geom {

/// A bitmap in the world. Cell (column, row) covers [column, column+1] × [row, row+1] times `resolution` in
/// the frame whose pose is `origin` (row 0 is at the bottom, as seen in that frame; the frame may be turned).
struct OccupancyGrid {
  int width = 0;
  int height = 0;
  double resolution = 0.05;  ///< m per cell
  Pose2 origin;              ///< pose of the lower-left corner of cell (0, 0)
  std::vector<std::uint8_t>
      occupied;  ///< width × height, row-major; 1 = obstacle (occupied or unknown), 0 = free

  bool blocked(int column, int row) const {
    return column < 0 || row < 0 || column >= width || row >= height ||
           occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(column)] != 0;
  }
  Box box() const;
};

/// What lies beyond the edges of a grid.
enum class Outside { blocked, free };

/// Rectangles in the world, turned like the grid, that together cover every blocked cell with a free
/// 8-neighbour; where the outside is free, cells at the edge of the grid have one. Whoever moves continuously
/// from a free place meets one of them before any other blocked cell. The outside of the grid is not covered:
/// see `surroundings`.
std::vector<Convex> boundary_rectangles(const OccupancyGrid& grid, Outside outside = Outside::blocked);

/// Convex pieces that together cover what of `within` lies outside the grid: up to four, one beyond each
/// edge. What sticks out by less than a micrometre is left out.
std::vector<Convex> surroundings(const OccupancyGrid& grid, const Box& within);

}  // namespace seine::geom
