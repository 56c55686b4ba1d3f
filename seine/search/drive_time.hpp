#pragma once

#include <span>

#include "seine/search/path.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::search {

/// s, how long a car takes for arcs one after the other, from rest to rest: each stretch in one gear with the
/// quickest speed profile within the limits on speed, acceleration and lateral acceleration, and what turning
/// the wheel at the arcs' joints adds where its rate is limited. An estimate to compare ways by: the
/// optimiser rounds the joints off. Infinite where a gear is driven that the car does not have.
double drive_time(std::span<const vehicle::Arc> arcs, const vehicle::Model& model);
/// The same for a sampled path.
double drive_time(const Path& path, const vehicle::Model& model);

}  // namespace seine::search
