#pragma once

#include <span>
#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/geom/vec2.hpp"

namespace seine::search {

/// How far a car may be from the pose it is tested at, within the time a test stands for.
struct Slack {
  double ahead = 0.0;      ///< m along the body's +x axis, ≥ 0
  double behind = 0.0;     ///< m along −x, ≥ 0
  double curvature = 0.0;  ///< 1/m, largest |κ| on that stretch
};

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
  void cover(const geom::Pose2& pose, const Slack& slack, std::span<geom::Vec2> out) const;
  /// The same for a body that may be displaced by any vector of at most `by` metres.
  void grow(const geom::Pose2& pose, double by, std::span<geom::Vec2> out) const {
    place(pose, by, by, by, out);
  }
  double reach() const { return reach_; }

 private:
  void place(const geom::Pose2& pose, double front, double rear, double side,
             std::span<geom::Vec2> out) const;
  struct Corner {
    geom::Vec2 point;
    bool front;  // of the box: +x side
    bool left;   // +y side
  };
  std::vector<Corner> corners_;
  double reach_ = 0.0;    // m, largest |p|
  double reach_x_ = 0.0;  // m, largest |p_x|
  double reach_y_ = 0.0;  // m, largest |p_y|
};

/// Whether two convex polygons (counter-clockwise, three points or more) are at least `clearance` ≥ 0 apart;
/// contact counts as apart at 0.
bool apart(std::span<const geom::Vec2> a, std::span<const geom::Vec2> b, double clearance);

}  // namespace seine::search
