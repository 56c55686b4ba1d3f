#pragma once

#include <cstdint>
#include <optional>

#include "seine/world/scenario.hpp"

namespace seine::bench {

/// A team of `robots` with a loaded net somewhere on a map of a building, to be carried 6 to 20 m of driving
/// away, through rooms and doors that a team can pass when it is narrow. Nothing when the draws of this seed
/// find no such place.
std::optional<world::Scenario> carry_scene(const geom::OccupancyGrid& map, int robots, std::uint64_t seed);

}  // namespace seine::bench
