#include "seine/geom/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/polygon.hpp"

namespace seine::geom {
namespace {

constexpr std::uint64_t kSeed = 5;

bool is_boundary(const OccupancyGrid& grid, int column, int row, Outside outside) {
  if (!grid.blocked(column, row)) return false;
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      const bool beyond = r < 0 || c < 0 || r >= grid.height || c >= grid.width;
      if (beyond ? outside == Outside::free : !grid.blocked(c, r)) return true;
    }
  }
  return false;
}

OccupancyGrid random_grid(Rng& rng) {
  OccupancyGrid grid;
  grid.width = 1 + rng.below(40);
  grid.height = 1 + rng.below(40);
  grid.resolution = rng.uniform(0.02, 0.2);
  grid.origin = {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0),
                 rng.below(2) == 0 ? 0.0 : rng.uniform(-3.0, 3.0)};
  grid.occupied.assign(static_cast<std::size_t>(grid.width * grid.height), rng.below(2) == 0 ? 1 : 0);
  for (int i = rng.below(12); i > 0; --i) {  // rooms and blocks
    const int column = rng.below(grid.width), row = rng.below(grid.height);
    const int right = column + rng.below(15), top = row + rng.below(15);
    const std::uint8_t fill = rng.below(2) == 0 ? 1 : 0;
    for (int r = row; r < std::min(top, grid.height); ++r) {
      for (int c = column; c < std::min(right, grid.width); ++c) {
        grid.occupied[static_cast<std::size_t>(r * grid.width + c)] = fill;
      }
    }
  }
  return grid;
}

TEST(Grid, RectanglesCoverExactlyTheBoundaryCells) {
  Rng rng(kSeed);
  for (int i = 0; i < 200; ++i) {
    const OccupancyGrid grid = random_grid(rng);
    const Outside outside = rng.below(2) == 0 ? Outside::free : Outside::blocked;
    const std::vector<Convex> rectangles = boundary_rectangles(grid, outside);
    for (const Convex& rectangle : rectangles) EXPECT_TRUE(is_convex(rectangle.core));
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        // Near all four corners of the cell, so that a rectangle that is short or long by a sliver shows.
        for (const Vec2 at : {Vec2{0.01, 0.01}, Vec2{0.99, 0.01}, Vec2{0.99, 0.99}, Vec2{0.01, 0.99}}) {
          const Vec2 p = grid.origin * (grid.resolution * (Vec2{double(column), double(row)} + at));
          bool covered = false;
          for (const Convex& rectangle : rectangles) covered = covered || contains(rectangle.core, p);
          ASSERT_EQ(covered, is_boundary(grid, column, row, outside)) << "seed " << kSeed << " case " << i;
        }
      }
    }
  }
}

TEST(Grid, SurroundingsAreWhatABoxHoldsBeyondIt) {
  Rng rng(kSeed);
  for (int i = 0; i < 300; ++i) {
    OccupancyGrid grid = random_grid(rng);
    if (rng.below(4) == 0) grid.origin.heading = 0.5 * std::numbers::pi * rng.below(4);
    Box box = grid.box();
    if (rng.below(2) == 0) box = box.inflated(rng.uniform(-0.3, 2.0));
    if (rng.below(3) == 0) box.high += {rng.uniform(-0.5, 1.0), rng.uniform(-0.5, 1.0)};
    if (box.empty()) continue;
    const std::vector<Convex> pieces = surroundings(grid, box);
    for (const Convex& piece : pieces) EXPECT_TRUE(is_convex(piece.core));
    for (int k = 0; k < 200; ++k) {
      const Vec2 p{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
      const Vec2 d = p - grid.origin.position(), along = grid.origin.direction();
      const double x = dot(along, d), y = cross(along, d);
      const double outside =
          std::max({-x, -y, x - grid.width * grid.resolution, y - grid.height * grid.resolution});
      if (std::abs(outside) < 1e-5) continue;
      bool covered = false;
      for (const Convex& piece : pieces) covered = covered || contains(piece.core, p);
      ASSERT_EQ(covered, outside > 0.0) << "seed " << kSeed << " case " << i;
    }
  }
}

TEST(Grid, NothingSurroundsAGridThatFillsItsBox) {
  Rng rng(kSeed);
  for (int i = 0; i < 200; ++i) {
    OccupancyGrid grid = random_grid(rng);
    grid.origin = {rng.uniform(-1e6, 1e6), rng.uniform(-1e6, 1e6), 0.5 * std::numbers::pi * rng.below(4)};
    EXPECT_TRUE(surroundings(grid, grid.box()).empty());
  }
}

TEST(Grid, StraightWallsAreOneRectangleEach) {
  OccupancyGrid grid{.width = 20,
                     .height = 10,
                     .resolution = 0.1,
                     .origin = {},
                     .occupied = std::vector<std::uint8_t>(200, 0)};
  for (int row = 0; row < 10; ++row) grid.occupied[static_cast<std::size_t>(row * 20 + 7)] = 1;
  for (int column = 0; column < 20; ++column) grid.occupied[static_cast<std::size_t>(column)] = 1;
  EXPECT_EQ(boundary_rectangles(grid).size(), 2U);
  EXPECT_DOUBLE_EQ(grid.box().high.x, 2.0);
}

}  // namespace
}  // namespace seine::geom
