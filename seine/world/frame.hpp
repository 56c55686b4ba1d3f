#pragma once

#include <optional>

#include "seine/world/scenario.hpp"

namespace seine::world {

/// Where planning has its origin when the coordinates are large (UTM: some 5e6 m), where products of
/// coordinates lose the digits that matter: in the middle of the bounds. Nothing when that is within a
/// kilometre of the origin as it is.
std::optional<geom::Vec2> local_origin(const Scenario& scenario);

/// The same question with `origin` (m, in its coordinates) as the origin; Scenario::origin remembers it.
/// Coordinates come out to 0.1 µm, less than the certificate sees: what was written with up to seven decimals
/// is then the very same number wherever the world lies, and so is all that follows from it.
Scenario seen_from(const Scenario& scenario, geom::Vec2 origin);

}  // namespace seine::world
