#pragma once

#include <span>

#include "seine/geom/convex.hpp"

namespace seine::constraint {

/// The exact signed distance of a car's footprint to a convex body that stands where it stands (a moving obstacle, or a car that is not being
/// planned, at one instant), less the body's radius. The car is at p with unit heading d.
/// @param footprint in the body frame, at most 32 vertices  @param g_position ∂/∂p  @param g_direction ∂/∂d
double moving_obstacle(geom::Vec2 p, geom::Vec2 d, std::span<const geom::Vec2> footprint,
                       std::span<const geom::Vec2> body, double radius, geom::Vec2& g_position,
                       geom::Vec2& g_direction);

/// The exact signed distance of two footprints, for shapes that are not rectangles. Gradients as above, for both.
struct FootprintGradient {
  geom::Vec2 position_a, direction_a, position_b, direction_b;
};
double footprint_distance(geom::Vec2 p_a, geom::Vec2 d_a, std::span<const geom::Vec2> footprint_a, geom::Vec2 p_b,
                          geom::Vec2 d_b, std::span<const geom::Vec2> footprint_b, FootprintGradient& gradient);

}  // namespace seine::constraint
