#pragma once

#include <string>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/base/workers.hpp"
#include "seine/baseline/letter/robot_task.hpp"
#include "seine/baseline/letter/settings.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::baseline::letter {

/// Every robot's way by Hybrid A*, each as if it were alone [Pei24, details on comparative experiments].
struct Guess {
  std::vector<RobotTask> robots;
  std::string reason;  ///< why not complete, else empty
};

/// Where each robot ends: its goal, or, where the task leaves that open, its place in the formation of the
/// start moved to the delivery. Empty when there is no room for that in the delivery region.
std::vector<geom::Pose2> final_poses(const world::Scenario& scenario, const world::StaticMap& map);

/// A car that rests at its goal gets a task without segments: it stands.
Guess guess(const world::Scenario& scenario, const world::StaticMap& map, const Settings& settings,
            const Deadline& deadline, Workers& workers);

}  // namespace seine::baseline::letter
