#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world::test {

/// The plain truth about a map, cell by cell, written without geom/convex and StaticMap: how far a convex
/// polygon is from all that the map blocks, m; minus the depth when it overlaps some of it. A lower bound
/// beyond the overlap, since it looks along the directions of edges only. No more than `cap`.
inline double cell_distance(const Scenario& scenario, std::span<const geom::Vec2> polygon, double cap) {
  const geom::OccupancyGrid& grid = *scenario.map;
  const double c = std::cos(grid.origin.heading), s = std::sin(grid.origin.heading), r = grid.resolution;
  std::vector<geom::Vec2> p;  // in the grid's frame, m
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const geom::Vec2 q : polygon) {
    const double x = q.x - grid.origin.x, y = q.y - grid.origin.y;
    p.push_back({c * x + s * y, c * y - s * x});
    left = std::min(left, p.back().x), right = std::max(right, p.back().x);
    low = std::min(low, p.back().y), high = std::max(high, p.back().y);
  }
  double least = cap;
  const double outside = std::min({left, low, grid.width * r - right, grid.height * r - high});
  if (!scenario.outside_free) least = std::min(least, outside);
  const auto first = [&](double at) { return std::max(0, static_cast<int>(std::floor((at - cap) / r))); };
  const auto last = [&](double at, int count) {
    return std::min(count - 1, static_cast<int>(std::floor((at + cap) / r)));
  };
  for (int row = first(low); row <= last(high, grid.height); ++row) {
    for (int column = first(left); column <= last(right, grid.width); ++column) {
      if (grid.occupied[static_cast<std::size_t>(row * grid.width + column)] == 0) continue;
      const double x0 = column * r, x1 = x0 + r, y0 = row * r, y1 = y0 + r;
      double gap = std::max({left - x1, x0 - right, low - y1, y0 - high});
      for (std::size_t i = 0; i < p.size(); ++i) {
        const geom::Vec2 a = p[i], b = p[(i + 1) % p.size()];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double nx = (b.y - a.y) / length, ny = (a.x - b.x) / length;  // outward
        const double nearest = (nx > 0.0 ? x0 : x1) * nx + (ny > 0.0 ? y0 : y1) * ny;
        gap = std::max(gap, nearest - (a.x * nx + a.y * ny));
      }
      least = std::min(least, gap);
    }
  }
  return least;
}

/// A map of rooms, blocks and speckle, solid to its edges or open there, turned, shifted, in bounds that are
/// its own, larger, or smaller; now and then free outside.
inline void add_random_map(Rng& rng, Scenario& scenario) {
  geom::OccupancyGrid grid;
  grid.width = 8 + rng.below(30), grid.height = 8 + rng.below(30);
  grid.resolution = rng.uniform(0.1, 0.4);
  const double turn = rng.below(3) == 0   ? 0.0
                      : rng.below(3) == 0 ? 0.5 * std::numbers::pi * rng.below(4)
                                          : rng.uniform(-3.1, 3.1);
  const geom::Vec2 half = 0.5 * grid.resolution * geom::Vec2{double(grid.width), double(grid.height)};
  const geom::Vec2 middle{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)};
  const geom::Vec2 corner = middle - geom::Pose2{0.0, 0.0, turn} * half;
  grid.origin = {corner.x, corner.y, turn};
  const bool solid = rng.below(3) == 0;
  grid.occupied.assign(static_cast<std::size_t>(grid.width * grid.height), solid ? 1 : 0);
  for (int i = rng.below(solid ? 9 : 5); i > 0; --i) {
    const int column = rng.below(grid.width), row = rng.below(grid.height);
    const int right = column + 3 + rng.below(grid.width), top = row + 3 + rng.below(grid.height);
    const std::uint8_t fill = solid ? 0 : 1;
    const bool thin = !solid && rng.below(2) == 0;
    for (int y = row; y < std::min(thin ? row + 1 : top, grid.height); ++y)
      for (int x = column; x < std::min(right, grid.width); ++x)
        grid.occupied[static_cast<std::size_t>(y * grid.width + x)] = fill;
  }
  for (int i = rng.below(4); i > 0; --i)
    grid.occupied[static_cast<std::size_t>(rng.below(grid.width * grid.height))] = 1;
  scenario.map = grid;
  scenario.bounds = grid.box();
  const int kind = rng.below(4);
  if (kind == 1) scenario.bounds = scenario.bounds.inflated(rng.uniform(0.0, 3.0));
  if (kind == 2) scenario.bounds = scenario.bounds.inflated(-rng.uniform(0.0, 0.3));
  if (kind == 3) scenario.bounds.high += {rng.uniform(0.0, 4.0), rng.uniform(-0.2, 0.5)};
  scenario.outside_free = rng.below(4) == 0;
}

}  // namespace seine::world::test
