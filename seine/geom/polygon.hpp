#pragma once

#include <span>
#include <string>
#include <vector>

#include "seine/geom/vec2.hpp"

namespace seine::geom {

/// Twice the signed area is positive for counter-clockwise polygons.
double signed_area(std::span<const Vec2> polygon);
bool contains(std::span<const Vec2> polygon, Vec2 point);
/// Empty when the polygon is simple (three or more distinct vertices, no two edges cross or touch, non-zero
/// area); otherwise what is wrong, naming the vertices or edges (counted from 1).
std::string why_not_simple(std::span<const Vec2> polygon);
/// The ring without what other programs write twice: the first vertex again at the end (GeoJSON, WKT),
/// vertices repeated one after the other, and a ring gone round several times. Two vertices are one when they
/// are within a nanometre or within the rounding of their coordinates. The rest stays as it is, bit by bit.
std::vector<Vec2> without_repeats(std::vector<Vec2> ring);
bool is_convex(std::span<const Vec2> counter_clockwise);
/// A simple polygon cut into convex parts, counter-clockwise each, that cover it exactly (ear clipping, then
/// merging of parts across diagonals [Hertel83]). Either orientation is accepted. Throws InputError when it
/// is not simple.
std::vector<std::vector<Vec2>> convex_parts(std::span<const Vec2> polygon);

}  // namespace seine::geom
