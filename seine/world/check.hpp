#pragma once

#include <string>
#include <vector>

#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {

/// Everything that makes a scenario unanswerable before any planning, one sentence each with names and
/// numbers; empty when nothing does. Limits, margins and footprints that make no sense; starts and goals
/// nearer than the margin to an obstacle, the bounds or each other (to within 1 µm: without a margin,
/// touching is allowed); moving obstacles over a start at t = 0 or at rest over a goal; and what check_net
/// finds. Poses of a car are not judged when its own numbers are already wrong.
std::vector<std::string> check(const Scenario& scenario, const StaticMap& map);

/// Throws InputError "<name>: <first complaint> (and 2 more)" when check has any.
void expect_sound(const Scenario& scenario, const StaticMap& map);

}  // namespace seine::world
