#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "seine/geom/box.hpp"
#include "seine/geom/vec2.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// The distance of points to everything that stands still and to the bounds, exact at the middles of square
/// cells and computed when first asked for: a search that looks at a corner of a large building pays for that
/// corner. Any number of threads may ask at once (two may compute the same value). Negative inside obstacles;
/// the inside of a map's solid regions may look free (see geom::boundary_rectangles), their edge never does.
class PointDistances {
 public:
  /// @param cell  m, side of a cell (made larger where a map would need more than 16 million of them)
  /// @param cap   m, distances beyond are given as `cap`
  PointDistances(const world::StaticMap& map, double cell, double cap);

  /// The distance of a point lies between these.
  struct Bounds {
    double lower, upper;  ///< m; upper is infinite where the distance may be beyond the cap
  };
  /// Outside of the bounds both are negative infinity.
  Bounds bounds(geom::Vec2 p) const;

  // As a grid: column and row of the cell under a point, its middle, and the distance there.
  int column(double x) const { return static_cast<int>(std::floor((x - low_.x) * inverse_)); }
  int row(double y) const { return static_cast<int>(std::floor((y - low_.y) * inverse_)); }
  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  geom::Vec2 middle(int column, int row) const {
    return {low_.x + (column + 0.5) * cell_, low_.y + (row + 0.5) * cell_};
  }
  /// Needs inside(column, row).
  double at(int column, int row) const;
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  double cap() const { return cap_; }

 private:
  float compute(int column, int row) const;

  const world::StaticMap* map_;
  geom::Vec2 low_;
  double cell_, inverse_, cap_;
  int columns_, rows_;
  struct Free {
    void operator()(std::atomic<std::uint32_t>* memory) const { std::free(memory); }
  };
  // The bits of a float, all turned; rounded towards −∞ by less than a micrometre. 0: not computed yet.
  std::unique_ptr<std::atomic<std::uint32_t>[], Free> value_;
};

}  // namespace seine::search
