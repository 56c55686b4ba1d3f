#pragma once

#include <optional>

#include "seine/certify/certificate.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// Whose time is stretched.
enum class Clock {
  own,     ///< only the stretches at fault, from rest to rest: the rest of the plan comes later
  common,  ///< everything by one factor: nobody's place relative to the others changes
};

/// By how much slower a plan must be driven, at its worst instant, when speeds, accelerations or steering
/// rates are all that the certificate complains of: f where a speed or a steering rate is f times its limit,
/// √f for an acceleration. Nothing when something else is broken, or when it is more than four.
std::optional<double> slowing(const certify::Certificate& certificate);

/// The plan driven as much slower as what the certificate found asks for, see `slowing`. Where it leads
/// stays as it is. Nothing where that is no answer, or where a stretch that begins in motion would have to be
/// slower: its speed at the start is given.
std::optional<traj::TeamTrajectory> slowed(const world::Scenario& scenario,
                                           const certify::Certificate& certificate,
                                           const traj::TeamTrajectory& plan, Clock clock);

struct Slowed {
  traj::TeamTrajectory plan;
  certify::Certificate certificate;  ///< holds
};

/// The plan slowed until it is certified, on each car's own clock if that does, else on the common one.
/// Nothing when slowing does not help. @param certificate of the plan
std::optional<Slowed> certified_slower(const world::Scenario& scenario, const world::StaticMap& map,
                                       const certify::Certificate& certificate,
                                       const traj::TeamTrajectory& plan, const certify::Options& options);

}  // namespace seine::planner
