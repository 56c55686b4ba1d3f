#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "seine/net/net.hpp"
#include "seine/world/static_map.hpp"

namespace seine::trajopt {

/// What one catch asks of the team, SI units.
struct CatchTask {
  double time = 0.0;            ///< s, the target's centre falls through the rim plane …
  geom::Vec2 point;             ///< … here …
  double margin = 0.3;          ///< … and is this far inside every edge of the net, m
  double contact_delay = 0.0;   ///< s later it meets the net, if both go on straight …
  double contact_margin = 0.2;  ///< … this far inside, m …
  double lean = 0.0;    ///< s², … and that also moved by this times the net's acceleration backwards
  geom::Vec2 velocity;  ///< of the target over ground, m/s
  double most_sideways = std::numeric_limits<double>::infinity();  ///< m/s relative to the net's middle
  double least_opening = 0.0;                                      ///< of the net at rest, at the catch
  double held_opening = 0.0;                                       ///< and for `hold` seconds after
  double hold = 0.0;                                               ///< s
  double least_spread = 0.0;  ///< m, of all attachments: the net no deeper …
  double most_radius = std::numeric_limits<double>::infinity();  ///< m, of any one: … and no flatter
};

/// From then on no car drives faster, for the air would blow what lies in the net out of it.
struct CarryTask {
  double from = 0.0;   ///< s
  double speed = 0.0;  ///< m/s
};

/// An obstacle low enough for the net to pass over.
struct LowObstacle {
  geom::Convex shape;
  double height = 0.0;  ///< m
};

/// What holding a net asks of the team, SI units.
struct NetTask {
  net::Net net;
  std::vector<CatchTask> catches;
  std::vector<CarryTask> carries;
  double loaded_from = std::numeric_limits<double>::infinity();  ///< s: when something lies in it
  std::optional<net::Delivery> delivery;
  const world::StaticMap* tall = nullptr;  ///< what the net must not hang over; must outlive the problem
  std::vector<LowObstacle> low;
  bool size = true, topology = true;  ///< switches for ablation
  double obstacle_slack = 0.0;        ///< m, kept between the net and what is tall
  double holding_reserve = 0.0;       ///< m², of net::holding_reserve while something lies in it
  double spread_slack = 0.0;          ///< m, on top of what keeps net and payload off the ground
};

/// Cars face the delivery's heading to within this, rad.
inline constexpr double kDeliveryHeading = 0.1;

}  // namespace seine::trajopt
