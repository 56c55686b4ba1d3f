#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "seine/geom/box.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/geom/vec2.hpp"

namespace seine::search {

/// How far a car may be from the pose it is tested at, within the time a test stands for.
struct Slack {
  double ahead = 0.0;      ///< m along the body's +x axis, ≥ 0
  double behind = 0.0;     ///< m along −x, ≥ 0
  double curvature = 0.0;  ///< 1/m, largest |κ| on that stretch
};

/// A rectangle turned by `axis`, a unit vector along its length.
struct OrientedBox {
  geom::Vec2 center, axis;
  double half_length = 0.0, half_width = 0.0;  ///< m
};

/// How two boxes stand to each other, as far as their four edge directions show it.
enum class Standing { kApart, kClose, kOverlap };
/// kApart: at least `clearance` apart; kOverlap: they share points; kClose: neither is certain.
inline Standing standing(const OrientedBox& a, const OrientedBox& b, double clearance) {
  const geom::Vec2 d = b.center - a.center;
  const double c = std::abs(dot(a.axis, b.axis)), s = std::abs(cross(a.axis, b.axis));
  const double along_a = std::abs(dot(d, a.axis)) - a.half_length - b.half_length * c - b.half_width * s;
  const double across_a = std::abs(cross(d, a.axis)) - a.half_width - b.half_length * s - b.half_width * c;
  const double along_b = std::abs(dot(d, b.axis)) - b.half_length - a.half_length * c - a.half_width * s;
  const double across_b = std::abs(cross(d, b.axis)) - b.half_width - a.half_length * s - a.half_width * c;
  const double gap = std::max(std::max(along_a, across_a), std::max(along_b, across_b));
  return gap >= clearance ? Standing::kApart : gap <= 0.0 ? Standing::kOverlap : Standing::kClose;
}

/// Squared distance of two boxes that do not overlap, m²: some corner of one of them is nearest.
double squared_distance(const OrientedBox& a, const OrientedBox& b);

/// A convex footprint that can be grown by the motion it stands for: its Minkowski sum with a box of variable
/// size. The corners of the sum are always the same pairs (footprint corner, box corner), so they are found
/// once.
class SweptFootprint {
 public:
  /// @param footprint convex, counter-clockwise, body frame, metres.
  explicit SweptFootprint(std::span<const geom::Vec2> footprint);

  std::size_t corners() const { return corners_.size(); }

  /// Writes a convex polygon (counter-clockwise, `corners()` points) that contains the footprint at every
  /// pose reached from `pose` by driving an arc within `slack`. A body point p moves by (δ − κδ p_y, κδ p_x)
  /// plus at most κ²δ²|p|/2 + |κ|δ²/2 for a driven δ.
  /// Returns a box around the polygon; the same set when the footprint is a rectangle along the body axes.
  OrientedBox cover(const geom::Pose2& pose, const Slack& slack, std::span<geom::Vec2> out) const;
  /// The same for a body that may be displaced by any vector of at most `by` metres.
  OrientedBox grow(const geom::Pose2& pose, double by, std::span<geom::Vec2> out) const {
    return place(pose, by, by, by, out);
  }
  bool is_box() const { return is_box_; }
  double reach() const { return reach_; }

 private:
  OrientedBox place(const geom::Pose2& pose, double front, double rear, double side,
                    std::span<geom::Vec2> out) const;
  struct Corner {
    geom::Vec2 point;
    bool front;  // of the box: +x side
    bool left;   // +y side
  };
  std::vector<Corner> corners_;
  geom::Box box_;  // of the footprint, body frame
  bool is_box_ = false;
  double reach_ = 0.0;    // m, largest |p|
  double reach_x_ = 0.0;  // m, largest |p_x|
  double reach_y_ = 0.0;  // m, largest |p_y|
};

/// Whether two convex polygons (counter-clockwise, three points or more) are at least `clearance` ≥ 0 apart;
/// contact counts as apart at 0.
bool apart(std::span<const geom::Vec2> a, std::span<const geom::Vec2> b, double clearance);

}  // namespace seine::search
