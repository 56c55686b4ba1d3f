#include "seine/geom/grid.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace seine::geom {
namespace {

// Blocked cells with a free 8-neighbour, 1 each; width × height. A free cell within one row and one column is
// found by two passes over bytes, which the compiler vectorises: maps have millions of cells and few boundary
// cells.
std::vector<std::uint8_t> boundary_cells(const OccupancyGrid& grid, Outside outside) {
  const std::size_t width = static_cast<std::size_t>(grid.width);
  const std::size_t height = static_cast<std::size_t>(grid.height);
  const std::uint8_t beyond = outside == Outside::free;
  std::vector<std::uint8_t> free_across((height + 2) * width, beyond);  // with a row below and one above
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* cell = grid.occupied.data() + row * width;
    std::uint8_t* out = free_across.data() + (row + 1) * width;
    for (std::size_t i = 0; i < width; ++i) out[i] = cell[i] == 0;
    for (std::size_t i = 1; i < width; ++i) out[i] = static_cast<std::uint8_t>(out[i] | (cell[i - 1] == 0));
    for (std::size_t i = 1; i < width; ++i)
      out[i - 1] = static_cast<std::uint8_t>(out[i - 1] | (cell[i] == 0));
    out[0] = static_cast<std::uint8_t>(out[0] | beyond);
    out[width - 1] = static_cast<std::uint8_t>(out[width - 1] | beyond);
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

// Less than this beyond an edge is nothing, m: what rounding leaves where a box and a grid are meant to end
// together, also after a change of frames, which snaps to 1e-7 m (world/frame.cpp).
constexpr double kSliver = 1e-6;

// What of a convex polygon lies beyond the line through `edge` with the given normal; empty where that is no
// more than a sliver.
std::vector<Vec2> part_beyond(const std::vector<Vec2>& polygon, Vec2 edge, Vec2 outward) {
  const auto height = [&](Vec2 p) { return dot(outward, p - edge); };
  double furthest = 0.0;
  for (const Vec2 p : polygon) furthest = std::max(furthest, height(p));
  if (furthest <= kSliver) return {};
  std::vector<Vec2> result;
  const auto add = [&](Vec2 p) {  // no edges whose direction is rounding
    const auto same = [&](Vec2 q) { return squared_norm(p - q) < 0.01 * kSliver * kSliver; };
    if (result.empty() || (!same(result.back()) && !same(result.front()))) result.push_back(p);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double ha = height(a), hb = height(b);
    if (ha >= 0.0) add(a);
    if ((ha < 0.0) != (hb < 0.0)) add(a + ha / (ha - hb) * (b - a));
  }
  return result;
}

}  // namespace

Box OccupancyGrid::box() const {
  const double w = width * resolution;
  const double h = height * resolution;
  Box result;
  for (const Vec2 corner : {Vec2{0.0, 0.0}, Vec2{w, 0.0}, Vec2{w, h}, Vec2{0.0, h}})
    result.include(origin * corner);
  return result;
}

std::vector<Convex> boundary_rectangles(const OccupancyGrid& grid, Outside outside) {
  const std::size_t width = static_cast<std::size_t>(grid.width);
  const std::size_t height = static_cast<std::size_t>(grid.height);
  if (width == 0 || height == 0) return {};
  const std::vector<std::uint8_t> boundary = boundary_cells(grid, outside);
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

std::vector<Convex> surroundings(const OccupancyGrid& grid, const Box& within) {
  const Vec2 across = grid.origin.direction(), up = left_normal(across);
  const Vec2 low = grid.origin.position();
  const Vec2 high = low + grid.width * grid.resolution * across + grid.height * grid.resolution * up;
  const std::vector<Vec2> whole{
      within.low, {within.high.x, within.low.y}, within.high, {within.low.x, within.high.y}};
  std::vector<Convex> result;
  for (const auto& [edge, outward] :
       {std::pair{low, -up}, std::pair{high, across}, std::pair{high, up}, std::pair{low, -across}}) {
    std::vector<Vec2> beyond = part_beyond(whole, edge, outward);
    if (!beyond.empty()) result.push_back({std::move(beyond), 0.0});
  }
  return result;
}

}  // namespace seine::geom
