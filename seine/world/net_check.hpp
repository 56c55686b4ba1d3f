#pragma once

#include "seine/world/check.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {

/// How far the goals' headings may be from the delivery's, rad.
inline constexpr double kDeliveryHeading = 0.1;

/// Appends what makes a task with a net unanswerable before any planning, one sentence each: a net whose
/// numbers make no sense or that fits another team; one that the starts (or the goals) stretch beyond its
/// limit, twist, hang over something it touches, or let drag; targets that never fall through the rim, or
/// before the plan begins; a delivery out of bounds or elsewhere than the goals. Nothing for a team without a
/// net.
void check_net(const Scenario& scenario, const StaticMap& map, Complaints& out);

/// The part of it that looks at numbers alone: a net that fits the team, targets and payload that can be.
void check_net_numbers(const Scenario& scenario, Complaints& out);

}  // namespace seine::world
