#pragma once

#include <algorithm>
#include <vector>

#include "seine/search/path.hpp"

namespace seine::search {

/// Walks along a path in the order of s: poses at a constant cost each, without a search or trigonometry.
class PathCursor {
 public:
  explicit PathCursor(const Path& path) : points_(path.points) {}

  /// Pose at driven length s; s must not decrease from call to call.
  geom::Pose2 advance(double s) {
    while (at_ + 2 < points_.size() && points_[at_ + 1].s <= s) ++at_;
    const PathPoint& a = points_[at_];
    if (at_ + 1 >= points_.size() || points_[at_ + 1].s <= a.s) return a.pose;
    const PathPoint& b = points_[at_ + 1];
    const double f = std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0);
    const double turn = geom::wrap_angle(b.pose.heading - a.pose.heading);
    // The arc bulges away from its chord by f(1 − f)/2 · turn · |chord|, up to third order in the turn.
    const geom::Vec2 chord = b.pose.position() - a.pose.position();
    const geom::Vec2 p =
        a.pose.position() + f * chord - (0.5 * f * (1.0 - f) * turn) * geom::left_normal(chord);
    return {p.x, p.y, a.pose.heading + f * turn};
  }
  /// The point whose stretch holds the last s asked for.
  const PathPoint& point() const { return points_[at_]; }
  std::size_t index() const { return at_; }

 private:
  const std::vector<PathPoint>& points_;
  std::size_t at_ = 0;
};

}  // namespace seine::search
