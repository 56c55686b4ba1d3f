#pragma once

#include <span>

#include "seine/geom/convex.hpp"

namespace seine::constraint {

/// The exact signed distance of two convex shapes that ride rigidly on (p, unit heading d): footprints that
/// are not rectangles, and moving obstacles. By the envelope theorem the gradient is that of the two nearest
/// points. At most 64 vertices each.
struct FootprintGradient {
  geom::Vec2 position_a, direction_a, position_b, direction_b;
};
double footprint_distance(geom::Vec2 p_a, geom::Vec2 d_a, std::span<const geom::Vec2> footprint_a,
                          geom::Vec2 p_b, geom::Vec2 d_b, std::span<const geom::Vec2> footprint_b,
                          FootprintGradient& gradient);

}  // namespace seine::constraint
