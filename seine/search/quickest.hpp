#pragma once

#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"

namespace seine::search {

/// The quickest by `drive_time` of the ways with one word (Reeds-Shepp, or of one gear) from the route's
/// start to its goal that are clear, for turns from as tight as `radius` (m) to several times as wide; the
/// route itself where none of them is quicker (it may have no arcs yet). Returns whether one was taken.
bool take_quickest_word(Route& route, const FootprintChecker& checker, double radius);

/// The quicker of two routes by `drive_time`; the first of equals.
bool quicker(const Route& route, const Route& than, const vehicle::Model& model);

}  // namespace seine::search
