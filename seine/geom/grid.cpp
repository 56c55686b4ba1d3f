#include "seine/geom/grid.hpp"

#include <cstddef>

namespace seine::geom {
namespace {

// Blocked cells with a free 8-neighbour inside the grid, 1 each; width × height. A free cell within one row
// and one column is found by two passes over bytes, which the compiler vectorises: maps have millions of
// cells and few boundary cells.
std::vector<std::uint8_t> boundary_cells(const OccupancyGrid& grid) {
  const std::size_t width = static_cast<std::size_t>(grid.width);
  const std::size_t height = static_cast<std::size_t>(grid.height);
  std::vector<std::uint8_t> free_across((height + 2) * width, 0);  // a row of nothing below and above
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* cell = grid.occupied.data() + row * width;
    std::uint8_t* out = free_across.data() + (row + 1) * width;
    for (std::size_t i = 0; i < width; ++i) out[i] = cell[i] == 0;
    for (std::size_t i = 1; i < width; ++i) out[i] = static_cast<std::uint8_t>(out[i] | (cell[i - 1] == 0));
    for (std::size_t i = 1; i < width; ++i)
      out[i - 1] = static_cast<std::uint8_t>(out[i - 1] | (cell[i] == 0));
  }
  std::vector<std::uint8_t> boundary(height * width);
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* cell = grid.occupied.data() + row * width;
    const std::uint8_t* below = free_across.data() + row * width;
    const std::uint8_t* here = below + width;
    const std::uint8_t* above = here + width;
    std::uint8_t* out = boundary.data() + row * width;
    for (std::size_t i = 0; i < width; ++i) {
      out[i] = static_cast<std::uint8_t>((cell[i] != 0) & ((below[i] | here[i] | above[i]) != 0));
    }
  }
  return boundary;
}

struct CellRectangle {
  std::size_t column, row, columns, rows;
};

// Grows from a cell first along one axis, then along the other, over boundary cells.
class Grower {
 public:
  Grower(const std::vector<std::uint8_t>& boundary, std::size_t width, std::size_t height)
      : boundary_(boundary), open_(boundary), width_(width), height_(height) {}

  bool open(std::size_t column, std::size_t row) const { return open_[row * width_ + column] != 0; }
  CellRectangle take(std::size_t column, std::size_t row) {
    const CellRectangle wide = grow(column, row, true);
    const CellRectangle tall = grow(column, row, false);
    const CellRectangle best = news(tall) > news(wide) ? tall : wide;
    for (std::size_t r = best.row; r < best.row + best.rows; ++r) {
      for (std::size_t c = best.column; c < best.column + best.columns; ++c) open_[r * width_ + c] = 0;
    }
    return best;
  }

 private:
  CellRectangle grow(std::size_t column, std::size_t row, bool across_first) const {
    CellRectangle r{column, row, 1, 1};
    if (across_first) grow_across(r);
    while (r.row + r.rows < height_ && filled({r.column, r.row + r.rows, r.columns, 1})) ++r.rows;
    if (!across_first) grow_across(r);
    return r;
  }
  void grow_across(CellRectangle& r) const {
    while (r.column + r.columns < width_ && filled({r.column + r.columns, r.row, 1, r.rows})) ++r.columns;
  }
  bool filled(const CellRectangle& r) const { return count(boundary_, r) == r.columns * r.rows; }
  std::size_t news(const CellRectangle& r) const { return count(open_, r); }
  std::size_t count(const std::vector<std::uint8_t>& cells, const CellRectangle& r) const {
    std::size_t sum = 0;
    for (std::size_t row = r.row; row < r.row + r.rows; ++row) {
      for (std::size_t column = r.column; column < r.column + r.columns; ++column)
        sum += cells[row * width_ + column];
    }
    return sum;
  }

  const std::vector<std::uint8_t>& boundary_;
  std::vector<std::uint8_t> open_;  // boundary cells not yet covered
  std::size_t width_, height_;
};

}  // namespace

Box OccupancyGrid::box() const {
  const double w = width * resolution;
  const double h = height * resolution;
  Box result;
  for (const Vec2 corner : {Vec2{0.0, 0.0}, Vec2{w, 0.0}, Vec2{w, h}, Vec2{0.0, h}})
    result.include(origin * corner);
  return result;
}

std::vector<Convex> boundary_rectangles(const OccupancyGrid& grid) {
  const std::size_t width = static_cast<std::size_t>(grid.width);
  const std::size_t height = static_cast<std::size_t>(grid.height);
  const std::vector<std::uint8_t> boundary = boundary_cells(grid);
  Grower grower(boundary, width, height);
  // The grid's axes in the world, one cell long.
  const Vec2 across = grid.resolution * grid.origin.direction();
  const Vec2 up = left_normal(across);
  std::vector<Convex> result;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      if (!grower.open(column, row)) continue;
      const CellRectangle r = grower.take(column, row);
      const Vec2 corner =
          grid.origin.position() + static_cast<double>(r.column) * across + static_cast<double>(r.row) * up;
      const Vec2 wide = static_cast<double>(r.columns) * across;
      const Vec2 tall = static_cast<double>(r.rows) * up;
      result.push_back({{corner, corner + wide, corner + wide + tall, corner + tall}, 0.0});
    }
  }
  return result;
}

}  // namespace seine::geom
