#pragma once

#include <optional>
#include <string>

#include "seine/net/target.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world {

/// Where a flying object meets an obstacle.
struct FlightObstruction {
  int obstacle = -1;    ///< index into Scenario::obstacles
  double time = 0.0;    ///< s, common clock
  double height = 0.0;  ///< m, of the object's centre then
  bool decided = true;  ///< false: it comes so near for so long that no more is known
};

/// The first obstacle that the target hits between its release and `until` (s), if any: obstacles that stand
/// and that move, as high as they are, to within a tenth of a millimetre. An obstacle
/// that it is released in, the thrower or a table, counts from when it has left it. Obstacles without a
/// height and the map are not looked at: nothing says how tall they are.
std::optional<FlightObstruction> flight_obstruction(const Scenario& scenario, const net::Target& target,
                                                    double until);

/// "flies into the hedge at t = 0.31 s, 1.2 m above the ground: it is 2 m tall".
std::string describe(const Scenario& scenario, const FlightObstruction& obstruction);

}  // namespace seine::world
