#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/world/scenario.hpp"

namespace seine::search {

struct RetimeOptions {
  Deadline deadline{};
  std::uint64_t seed = 0;
  double extra_robot_clearance =
      0.0;  ///< m, on top of the scenario's margin where starts and goals leave that much room
  const std::vector<std::optional<TimedPath>>* fixed =
      nullptr;  ///< robots that keep their motion (one entry a robot)
  LatticeOptions lattice{};
};

/// When everybody can drive, the paths being given: fastest velocity plans one after the other in this order,
/// each among those before it, the fixed robots and the moving obstacles; then other orders while somebody
/// finds no motion, and shifts that lower the sum of arrivals. Static obstacles are not looked at: the paths
/// keep clear of them or not.
/// @param paths one a robot, any driveable curve (also a smoothed one); not used for fixed robots
/// @param order robots, each once (the fixed may be left out); empty: who is in the way goes first, then the
/// longest way
/// @return one timed path a robot, collision-free on the common clock; nothing when some path admits no
/// motion
std::optional<std::vector<TimedPath>> retime(const world::Scenario& scenario, std::span<const Path> paths,
                                             std::span<const int> order = {},
                                             const RetimeOptions& options = {});

}  // namespace seine::search
