#pragma once

#include <span>
#include <vector>

#include "seine/geom/pose2.hpp"

// Distances written down a second time, by their definitions: nothing of seine/geom but points and poses.
namespace seine::deceive {

using Polygon = std::vector<geom::Vec2>;

/// The polygon in the world, its body frame being at `pose`.
Polygon placed(std::span<const geom::Vec2> body, const geom::Pose2& pose);

/// From a point to the nearest point of a polygon's rim, m.
double distance_to_rim(geom::Vec2 point, std::span<const geom::Vec2> polygon);
/// By the crossing number; the rim counts as either.
bool inside(geom::Vec2 point, std::span<const geom::Vec2> polygon);

/// Between two convex polygons; where they overlap, minus the least translation along an edge's normal that
/// parts them.
double convex_distance(std::span<const geom::Vec2> a, std::span<const geom::Vec2> b);
/// Between any two simple polygons; where they overlap, minus the depth of the deepest vertex.
double polygon_distance(std::span<const geom::Vec2> a, std::span<const geom::Vec2> b);
/// From a polygon to a disc, negative where they overlap.
double disc_distance(std::span<const geom::Vec2> polygon, geom::Vec2 center, double radius);

}  // namespace seine::deceive
