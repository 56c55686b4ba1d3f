#pragma once

#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// Signed distance of the net polygon (convex, counter-clockwise) to a convex obstacle it must not hang over;
/// negative when they overlap.
/// @param gradient one entry an attachment
double net_clearance(std::span<const geom::Vec2> polygon, std::span<const geom::Vec2> obstacle,
                     std::span<geom::Vec2> gradient);

}  // namespace seine::constraint
