#pragma once

#include <cstdint>
#include <vector>

#include "seine/geom/vec2.hpp"
#include "seine/search/path_planner.hpp"

namespace seine::search {

/// One to three random places about the way from `from` to `to` that cost extra to drive through, so that a
/// search finds another way than usual: other sides, other gear changes.
/// @param length  m, of the car
std::vector<Bump> whims(geom::Vec2 from, geom::Vec2 to, double length, std::uint64_t seed);

/// Whether a path has a change between forwards and backwards.
bool changes_gear(const Path& path);

}  // namespace seine::search
