#pragma once

#include "seine/geom/grid.hpp"

namespace seine::geom {

/// Whether `occupied` has all the cells that width and height say, and they have a size and a place. Every
/// function that takes a grid relies on it.
bool is_complete(const OccupancyGrid& grid);

}  // namespace seine::geom
