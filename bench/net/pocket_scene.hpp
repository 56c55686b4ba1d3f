#pragma once

#include <cstdint>

#include "seine/world/scenario.hpp"

namespace seine::bench {

/// A team with a loaded net faces the end of a pocket and has to go on beside it, in the direction it faces:
/// it must back out and change gear.
world::Scenario pocket_scene(int robots, std::uint64_t seed);

}  // namespace seine::bench
