#pragma once

#include <span>
#include <string>

#include "seine/base/deadline.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Why cars that have a way alone found no motion among the others, for people: whose goal, whose start or
/// which obstacle that has come to rest closes their way, where one does. Found by a few searches, not
/// proved.
/// @param robots  those without a motion; the first few are explained
std::string why_no_motion(const world::Scenario& scenario, const world::StaticMap& map,
                          std::span<const int> robots, const Deadline& deadline);

}  // namespace seine::search
