#pragma once

#include <optional>
#include <span>

#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::search {

/// Seconds from rest to rest along arcs: each stretch in one gear at the limits of speed and acceleration,
/// and the time the wheel takes to turn from arc to arc. Infinite where a gear is needed that the car does
/// not have.
double driving_time(std::span<const vehicle::Arc> arcs, const vehicle::Model& model);
/// The same for a sampled path.
double driving_time(const Path& path, const vehicle::Model& model);

/// The quickest clear move between two poses that are close together: straight on or back where that meets
/// the goal as nearly as the certificate grants (the route then ends there and not exactly at the goal), else
/// a Reeds-Shepp word of a few short stretches. Nothing when the poses are further apart than two car
/// lengths, or no such move is clear.
std::optional<Route> short_move(const geom::Pose2& start, const geom::Pose2& goal,
                                const FootprintChecker& checker);

}  // namespace seine::search
