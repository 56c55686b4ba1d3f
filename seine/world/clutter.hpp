#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/vec2.hpp"

namespace seine::world {

/// A convex polygon inscribed in a circle; only the circle matters for where it may stand.
struct Clutter {
  geom::Vec2 center;
  double radius;
};

inline bool far_from(std::span<const Clutter> clutter, geom::Vec2 point, double gap) {
  return std::all_of(clutter.begin(), clutter.end(),
                     [&](const Clutter& c) { return geom::norm(c.center - point) >= c.radius + gap; });
}

inline std::vector<geom::Vec2> inscribed_polygon(const Clutter& clutter, Rng& rng) {
  const int corners = 3 + rng.below(5);
  const double turn = rng.uniform(0.0, 2.0 * std::numbers::pi);
  std::vector<geom::Vec2> polygon;
  for (int i = 0; i < corners; ++i) {
    // Each corner keeps to the middle 60 % of its share of the circle: no needles, no coinciding corners.
    const double angle = turn + 2.0 * std::numbers::pi * (i + rng.uniform(-0.3, 0.3)) / corners;
    polygon.push_back(clutter.center + clutter.radius * geom::unit(angle));
  }
  return polygon;
}

}  // namespace seine::world
