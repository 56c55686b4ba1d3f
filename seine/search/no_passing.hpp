#pragma once

#include <cstddef>

#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Proves that two cars cannot both get to their goals, whoever goes first: in a lane without a bay, a dead
/// end, a house whose only door one of them stands in.
///
/// Each car is replaced by the largest disc in its footprint, which has to keep the margin to everything that
/// stands still and to the other car's disc, and may otherwise move as it likes. The pairs of square cells in
/// which the two discs may be are flooded from the starts. A cell counts as free when any point of it is, and
/// a pair when any two points of theirs are far enough apart: where the goals are not reached, no motion
/// exists. Moving obstacles and the other cars only make it harder.
///
/// It says nothing about cars that are stuck because they are long, or turn wide.
/// @param most_pairs of cells, to keep it quick: cells get smaller, from half a car's width on, while there
/// are no more of them
/// @return false: not proved
bool cannot_both_arrive(const world::Scenario& scenario, const world::StaticMap& map, int a, int b,
                        std::size_t most_pairs);

}  // namespace seine::search
