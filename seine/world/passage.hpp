#pragma once

#include <span>

#include "seine/geom/box.hpp"
#include "seine/geom/vec2.hpp"
#include "seine/world/clutter.hpp"

namespace seine::world {

/// Whether a disc of radius `half_width` (m) can be moved from one place to the other without touching any of
/// the circles or leaving `room`, which must hold both places, as far as a grid of 0.2 m can tell.
bool passage(std::span<const Clutter> circles, const geom::Box& room, geom::Vec2 from, geom::Vec2 to,
             double half_width);

}  // namespace seine::world
