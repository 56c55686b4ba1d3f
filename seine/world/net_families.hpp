#pragma once

#include <cstdint>

#include "seine/world/scenario.hpp"

namespace seine::world {

/// The teams for which there are instances.
inline constexpr int kLeastNetTeam = 3, kMostNetTeam = 8;
/// m, how wide a gap may be asked for.
inline constexpr double kNarrowestGap = 1.0, kWidestGap = 10.0;

/// The net of the families for `robots` cars: regular, its side 2.2, 2.0, 1.7, 1.4, 1.3, 1.2 m for 3 … 8,
/// held 1 m above the ground, 0.2 m ahead of the rear axles.
net::Net family_net(int robots);

enum class Clutteredness { few, dense };  ///< 0 … 8 obstacles, or 10 … 22

/// A throw that the team must catch and bring somewhere: the team of size `robots` that belongs to `seed`,
/// the same bytes on every platform. Hard but not impossible (docs/scenario.md says how that is ensured).
/// Throws InputError for numbers that make no sense.
Scenario throw_scene(int robots, std::uint64_t seed, Clutteredness clutteredness = Clutteredness::few);

/// A load that the team must carry through a wall with one gap, `width` metres wide.
Scenario gap_scene(int robots, std::uint64_t seed, double width = 2.6);

}  // namespace seine::world
