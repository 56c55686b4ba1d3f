#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/search/path.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Smallest distance of the footprint to the map along the path, looked at every `step` metres.
inline double smallest_distance(const Path& path, const world::StaticMap& map, const vehicle::Model& model,
                                double step) {
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<geom::Vec2> polygon(model.footprint.size());
  for (double s = 0.0;; s += step) {
    geom::place(model.footprint, pose_at(path, s), polygon);
    smallest = std::min(smallest, map.nearest(polygon, model.length()).distance);
    if (s >= path.length()) return smallest;
  }
}

/// Headings to `tolerance`, positions too unless they are so far from the origin that doubles are coarser
/// (parking case 15).
inline void expect_same_pose(const geom::Pose2& a, const geom::Pose2& b, double tolerance) {
  const double far = std::max(std::abs(a.x), std::abs(a.y));
  EXPECT_LE(geom::norm(a.position() - b.position()), tolerance + 1e-15 * far);
  EXPECT_NEAR(geom::wrap_angle(a.heading - b.heading), 0.0, tolerance);
}

/// The points are what the labels say: each follows from the one before by its arc, gears change only at
/// doubled points.
inline void expect_driveable(const Path& path, const vehicle::Model& model) {
  ASSERT_FALSE(path.points.empty());
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& p = path.points[i];
    EXPECT_LE(std::abs(p.curvature), model.max_curvature() * (1.0 + 1e-9));
    EXPECT_EQ(std::abs(p.gear), 1);
    if (i == 0) continue;
    const PathPoint& before = path.points[i - 1];
    const double step = p.s - before.s;
    EXPECT_GE(step, 0.0);
    EXPECT_LE(step, kPathSpacing * model.length() + 1e-9);
    if (p.gear != before.gear) {
      EXPECT_EQ(step, 0.0);
      EXPECT_EQ(p.pose, before.pose);
    }
    expect_same_pose(vehicle::drive(before.pose, before.curvature, before.gear * step), p.pose, 1e-6);
  }
}

inline void expect_sound(const Path& path, const geom::Pose2& start, const geom::Pose2& goal,
                         const world::StaticMap& map, const vehicle::Model& model, double clearance,
                         double step = 0.002) {
  expect_driveable(path, model);
  EXPECT_EQ(path.points.front().pose, start);
  EXPECT_EQ(path.points.back().pose, goal);
  EXPECT_GE(smallest_distance(path, map, model, step), clearance);
}

inline int gear_changes(const Path& path) {
  int changes = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i)
    changes += path.points[i].gear != path.points[i - 1].gear;
  return changes;
}

/// Length of the shortest stretch in one gear, m.
inline double shortest_stretch(const Path& path) {
  double shortest = path.length(), begin = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    if (path.points[i].gear == path.points[i - 1].gear) continue;
    shortest = std::min(shortest, path.points[i].s - begin);
    begin = path.points[i].s;
  }
  return std::min(shortest, path.length() - begin);
}

inline void expect_equal(const Path& a, const Path& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].s, b.points[i].s);
    EXPECT_EQ(a.points[i].pose, b.points[i].pose);
    EXPECT_EQ(a.points[i].curvature, b.points[i].curvature);
    EXPECT_EQ(a.points[i].gear, b.points[i].gear);
  }
}

}  // namespace seine::search
