#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::geom {

/// An axis-aligned box; empty (and absorbed by `include`) when default-made.
struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void include(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  Box inflated(double by) const { return {{low.x - by, low.y - by}, {high.x + by, high.y + by}}; }
  bool contains(Vec2 p) const { return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y; }
  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
  }
  bool empty() const { return low.x > high.x || low.y > high.y; }
  Vec2 size() const { return high - low; }
  Vec2 center() const { return 0.5 * (low + high); }
};

inline Box bounding_box(std::span<const Vec2> points) {
  Box box;
  for (const Vec2 p : points) box.include(p);
  return box;
}

}  // namespace seine::geom
