#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "seine/geom/grid.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world {

/// Random instances of one kind, for tests and measurements. All cars are `standard_car()`.
enum class Family {
  random,    ///< convex clutter, everybody about 10 m to go, the same car density for every large team
  swap,      ///< starts on a circle, goals opposite: every straight way leads through one point
  corridor,  ///< two rooms joined by a bottleneck two lanes wide; half of the team comes from either side
  parking,   ///< a row of slots between parked cars: half of the team backs out, the other half backs in
};

const char* name_of(Family family);
std::optional<Family> family_named(std::string_view name);
/// All of them, in the order of the enumeration.
std::span<const Family> all_families();

struct FamilyOptions {
  std::optional<int>
      obstacles;  ///< how many, for `random` only; default: 20 in 20 × 20 m, growing with the area
};

/// The team of size `robots` (1 … 10 000) that belongs to `seed`: the same bytes on every platform. Always
/// terminates: where there is no room the world grows. Throws InputError for numbers that make no sense.
Scenario generate(Family family, int robots, std::uint64_t seed, const FamilyOptions& options = {});

/// A team of standard cars on a map, all within 20 m of driving of one random place: rear axles on free cells
/// 0.9 m from everything blocked and from the map's edge, starts and goals 1.3 m apart from each other, 5 to
/// 25 m of driving from start to goal through gaps 1 m wide or more, headings within 0.5 rad of that way.
/// Deterministic; throws InputError when the map has no room for it.
Scenario on_map(const geom::OccupancyGrid& map, int robots, std::uint64_t seed);

/// The car of the native scenarios (design defaults): 0.60 × 0.40 m, 2.5 m/s, 3 m/s².
vehicle::Model standard_car();

}  // namespace seine::world
