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

/// How far the empty net hangs below its rim between two attachments `distance` (m) apart whose cloth is
/// `rest` (m) long: the parabola of that length, √(3/8 d (ℓ − d)) to leading order; 0 when d ≥ ℓ.
double sag(double distance, double rest);

/// The deepest such sag over all pairs, m.
double empty_depth(const Net& net, std::span<const geom::Vec2> attachments);

/// Distance of `p` to the nearest edge of a convex counter-clockwise polygon, m: positive inside, negative
/// outside.
double margin_inside(std::span<const geom::Vec2> polygon, geom::Vec2 p);

}  // namespace seine::net
