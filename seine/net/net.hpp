#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "seine/geom/vec2.hpp"

namespace seine::net {

/// Where a robot holds the net: a point of its body frame.
struct Attachment {
  geom::Vec2 at;
  double height = 1.0;  ///< h_k, m
};

/// A net held by a team: at rest a flat convex polygon. Vertex k hangs from robot k, in ring order,
/// counter-clockwise.
struct Net {
  std::vector<geom::Vec2> rest;         ///< r_k, m
  std::vector<Attachment> attachments;  ///< one a robot, all of the same height
  double stretch = 0.95;                ///< ρ: |a_i − a_j| ≤ ρ |r_i − r_j| for every pair
  double clearance = 0.05;              ///< m, of the lowest point of net and payload above what is under it
  double rebound = 0.25;  ///< e: 90th percentile of (speed after / before) of an object falling on the middle

  std::size_t size() const { return rest.size(); }
  /// Height of the rim plane, m.
  double rim() const { return attachments.front().height; }
};

/// What lies in the net.
struct Payload {
  double radius = 0.08;  ///< m
  double mass = 0.25;    ///< kg
};

/// Where the payload must come to rest with the team, and optionally which way every car then faces.
struct Delivery {
  geom::Vec2 center;
  double radius = 0.5;  ///< m: the mean of the attachments ends within it
  std::optional<double> heading;
};

}  // namespace seine::net
