#pragma once

#include <optional>
#include <span>

#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"

namespace seine::search {

/// `drive_time` and what each stretch in one gear takes longer for its smooth ends: of two moves with
/// different numbers of stretches neither looks too quick.
double smooth_drive_time(std::span<const vehicle::Arc> arcs, const vehicle::Model& model);

/// The quickest clear move between two poses that are close together: straight on or back where that meets
/// the goal as nearly as the certificate grants (the route then ends there and not exactly at the goal), else
/// a Reeds-Shepp word of a few short stretches. Nothing when the poses are further apart than two car
/// lengths, or no such move is clear.
std::optional<Route> short_move(const geom::Pose2& start, const geom::Pose2& goal,
                                const FootprintChecker& checker);

}  // namespace seine::search
