#pragma once

#include <vector>

#include "seine/search/formation.hpp"

namespace seine::search {

/// Shapes for narrow places: the net turned and squeezed across a direction as far as it may be, one for each
/// of some directions. They keep the net safe (within its stretch, off the ground, convex) and the cars
/// apart. @param heading of the cars  @param loaded whether something lies in the net  @param above m, the
/// net's lowest point stays this far above the ground
std::vector<Formation> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded,
                                     double above);

}  // namespace seine::search
