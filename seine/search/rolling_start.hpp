#pragma once

#include <optional>
#include <string>

#include "seine/search/path.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// A car that is moving when planning starts.
struct RollingStart {
  const world::StaticMap* map = nullptr;
  const vehicle::Model* model = nullptr;
  geom::Pose2 pose;
  double speed = 0.0;      ///< m/s, signed, not 0
  double clearance = 0.0;  ///< m, to obstacles
  double step = 0.0;       ///< s, of the velocity plan: within less than that it does not stop

  int gear() const { return speed < 0.0 ? -1 : 1; }
  /// m, until it rests when it brakes with so much of its acceleration.
  double braking_distance(double share) const;
};

/// Whether the car can follow the path from its speed on, braking with at most `share` of its acceleration:
/// in time for the first gear change or the end, and for the bends before.
bool follows(const RollingStart& start, const Path& path, double share);

/// The way straight on until the car rests, braking with `share` of its acceleration; none when it is not
/// clear.
std::optional<Path> brake_straight(const RollingStart& start, double share);

/// The way straight on up to what is ahead, where braking with `share` of its acceleration stops the car in
/// time; none elsewhere. It leaves more room to brake than `brake_straight` does with the same share.
std::optional<Path> brake_before_obstacle(const RollingStart& start, double share);

/// Why a car that is moving cannot stop, or hardly, in the driver's words: the needed and the available
/// distance. Empty when it can with ease.
std::string no_room_to_stop(const RollingStart& start);

}  // namespace seine::search
