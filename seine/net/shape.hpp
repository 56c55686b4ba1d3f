#pragma once

#include <cstddef>
#include <span>

#include "seine/geom/vec2.hpp"
#include "seine/net/net.hpp"

namespace seine::net {

/// m: how far the corners next to a ring edge stay on its inner side, so that the ring is never twisted.
inline constexpr double kConvexMargin = 0.05;

/// |r_i − r_j|, m: how far the cloth reaches between two corners when it lies flat.
double rest_distance(const Net& net, std::size_t i, std::size_t j);

/// How far the net is open: √(area of the attachments' polygon / area at rest). 0 when that polygon is not
/// counter-clockwise.
double opening(const Net& net, std::span<const geom::Vec2> attachments);

/// Radius of the largest circle inside a convex counter-clockwise polygon, m.
double inradius(std::span<const geom::Vec2> polygon);

/// How far a strip of cloth `rest` (m) long hangs below two points of one height, `distance` (m) apart: a
/// catenary; 0 when d ≥ ℓ, ℓ/2 when d = 0.
double sag(double distance, double rest);

/// The deepest such sag over all pairs, m: about where an empty net hangs. Not a bound, since the rest of the
/// cloth holds a strip up and weighs on it; that is `loaded_depth` (hanging.hpp), below which no cloth hangs.
double empty_depth(const Net& net, std::span<const geom::Vec2> attachments);

/// Distance of `p` to the nearest edge of a convex counter-clockwise polygon, m: positive inside, negative
/// outside.
double margin_inside(std::span<const geom::Vec2> polygon, geom::Vec2 p);

}  // namespace seine::net
