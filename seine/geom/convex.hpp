#pragma once

#include <span>
#include <vector>

#include "seine/geom/box.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/geom/vec2.hpp"

namespace seine::geom {

/// A convex shape: the points within `radius` of a convex core. The core's vertices are counter-clockwise
/// without repetition; one vertex makes a disc, two a capsule, three and more a (rounded) polygon.
struct Convex {
  std::vector<Vec2> core;
  double radius = 0.0;

  Box box() const { return bounding_box(core).inflated(radius); }
};

/// The convex shape in the world whose body frame stands at `pose`.
Convex placed(const Convex& body, const Pose2& pose);
/// The same without allocation: `out` has as many points as `body`.
void place(std::span<const Vec2> body, const Pose2& pose, std::span<Vec2> out);

/// Convex hull, counter-clockwise, without collinear or repeated points. Needs at least one point.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// How two convex sets stand to each other.
struct Separation {
  double
      distance;  ///< exact Euclidean gap; when they overlap, minus the smallest translation that parts them
  Vec2 normal;   ///< unit, from a towards b: moving b by it increases the distance
  Vec2 point_a;  ///< a witness on a's boundary
  Vec2 point_b;  ///< a witness on b's boundary
};

/// Exact signed distance of two convex polygons (cores only, radius 0), counter-clockwise, one vertex or more
/// each.
Separation separation(std::span<const Vec2> a, std::span<const Vec2> b);
/// The same with both radii taken off.
Separation separation(const Convex& a, const Convex& b);
/// separation(a, b).distance without the witnesses, faster.
double distance(std::span<const Vec2> a, std::span<const Vec2> b);
/// The distance where it is less than `enough`, otherwise any lower bound of it that is not: faster still.
double distance_up_to(std::span<const Vec2> a, std::span<const Vec2> b, double enough);

}  // namespace seine::geom
