#pragma once

#include <span>
#include <vector>

#include "seine/net/target.hpp"
#include "seine/sim/plan_clock.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::sim {

/// Where the robots hold the net at a time on the plan's clock.
std::vector<geom::Vec2> attachments_at(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                                       double plan_time);

/// What a plan that began at `begin` (s) is worth, now that the targets are seen to fly as they do.
struct Worth {
  double shortfall =
      0.0;  ///< m that margins lack, all targets; openings too narrow count their part of a metre
  double arrival = 0.0;  ///< s, when all have come to rest
};
Worth worth_of(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double begin,
               std::span<const net::Target> targets);
/// Whether a plan is worth changing to: it catches better, or catches as well and ends clearly sooner.
bool better(const Worth& candidate, const Worth& current);

/// The task that is left at `time` when the team is where `plan` has it at `plan_time`: clocks start then,
/// `targets` are those to catch, what was caught has become payload.
world::Scenario task_left(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double plan_time,
                          double time, std::span<const net::Target> targets);

}  // namespace seine::sim
