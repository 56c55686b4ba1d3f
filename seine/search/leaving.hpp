#pragma once

#include <optional>
#include <vector>

#include "seine/search/path.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// Whether a car starts nearer to what stands still than the margin, as Margins::leaving allows.
bool starts_inside_margin(const world::Scenario& scenario, const world::StaticMap& map,
                          const world::Robot& robot);

/// Short ways for such a car to a place with the whole margin, which never come nearer than
/// Margins::leaving: one arc, or two in different gears where no single one does. The shortest of each gear
/// they begin in and each side they turn to, by length.
std::vector<Path> ways_out(const world::Scenario& scenario, const world::StaticMap& map,
                           const world::Robot& robot);

}  // namespace seine::search
