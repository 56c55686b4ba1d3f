#pragma once

#include <vector>

#include "seine/certify/catching.hpp"
#include "seine/certify/clearance.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// What was found out about the net.
struct NetVerdict {
  std::vector<Finding> findings;
  NetRoom room;
  std::vector<net::Catch> catches;
};

/// What keeps the net's question from being asked at all: as many corners as robots. Empty when nothing does.
std::string why_no_net(const world::Scenario& scenario);

/// The team's net over the whole plan: size, shape, height, obstacles, catches, delivery. All robots are
/// charted up to the scene's horizon, which is kHoldTime after the last catch at the earliest.
NetVerdict prove_net(Context& context, const Scene& scene, const traj::TeamTrajectory& plan,
                     const std::vector<std::optional<net::Crossing>>& crossings);

}  // namespace seine::certify
