#pragma once

#include <span>
#include <vector>

#include "seine/search/formation.hpp"

namespace seine::search {

/// Shapes for narrow places: the net turned and squeezed across a direction as far as it may be, one for each
/// of some directions. They keep the net safe (within its stretch, off the ground, convex) and the cars
/// apart. @param heading of the cars  @param loaded whether something lies in the net  @param above m,
/// ascending: the net's lowest point stays so far above the ground; a shape that serves two of them comes
/// once
std::vector<Formation> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded,
                                     std::span<const double> above);

}  // namespace seine::search
