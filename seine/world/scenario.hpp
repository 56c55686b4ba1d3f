#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "seine/geom/box.hpp"
#include "seine/geom/grid.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/net/net.hpp"
#include "seine/net/target.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::world {

/// A point of a moving obstacle's way: at time t its body frame is at (x, y), turned by `heading`.
struct Waypoint {
  double t = 0.0;
  geom::Pose2 pose;
};

struct Circle {
  geom::Vec2 center;
  double radius = 0.0;
};

/// Something to stay clear of. Static: the shape is in world coordinates and `motion` is empty. Moving: the
/// shape is in a body frame that goes straight between the waypoints on the common clock, stands at the first
/// before it and at the last after it. (Loaders turn a moving circle's `center` and a moving polygon into
/// that frame.)
struct Obstacle {
  std::string name;  ///< for messages: the user's, or "obstacle 3" (counted from 1)
  std::variant<std::vector<geom::Vec2>, Circle> shape;      ///< a simple polygon, or a circle
  double height = std::numeric_limits<double>::infinity();  ///< m
  std::vector<Waypoint> motion;                             ///< times strictly increasing
};

/// Whether the obstacle is in one place from t = 0 on, with or without a `motion`: it is then an obstacle
/// like any static one, which paths lead round.
inline bool stands_still(const Obstacle& obstacle) {
  const auto& motion = obstacle.motion;
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    const geom::Pose2 &a = motion[i].pose, &b = motion[i + 1].pose;
    if (motion[i + 1].t > 0.0 && (a.x != b.x || a.y != b.y || a.heading != b.heading)) return false;
  }
  return true;
}

struct Robot {
  std::string name;
  int model = 0;  ///< index into Scenario::models
  geom::Pose2 start;
  double start_speed = 0.0;         ///< m/s, signed
  std::optional<geom::Pose2> goal;  ///< reached at rest; absent: anywhere (only in a team with a net)

  /// Whether it rests at its goal already, so that it may stand: as nearly as the certificate grants
  /// (docs/certificate.md), less some rounding.
  bool rests_at_goal() const;
};

inline bool Robot::rests_at_goal() const {
  constexpr double kSamePlace = 9e-5;  // m, and rad of the heading
  return goal && start_speed == 0.0 && geom::norm(goal->position() - start.position()) <= kSamePlace &&
         std::abs(geom::wrap_angle(goal->heading - start.heading)) <= kSamePlace;
}

/// Certified clearances, metres.
struct Margins {
  double robot = 0.05;     ///< between footprints
  double obstacle = 0.05;  ///< of footprints to obstacles and to the bounds
  /// To what stands still, for a car that starts nearer than `obstacle` to it: suffices until the car first
  /// has the whole margin. Absent: no car may start so near.
  std::optional<double> leaving{};
};

/// The question: who, where, among what, to where. Plain data; SI units, radians, one fixed frame.
struct Scenario {
  std::string name;
  /// Where the origin of all coordinates lies in those of the user, m: only messages add it.
  geom::Vec2 origin;
  geom::Box bounds;  ///< footprints stay inside
  std::optional<geom::OccupancyGrid> map;
  /// Whether ground beyond the map's picture is free. Otherwise it is what nobody has seen: an obstacle, like
  /// the picture's own unknown cells.
  bool outside_free = false;
  std::vector<Obstacle> obstacles;
  std::vector<vehicle::Model> models;  ///< at least one
  Margins margins;
  std::vector<Robot> robots;
  std::optional<net::Net> net;            ///< held by the robots in their order
  std::vector<net::Target> targets;       ///< to be caught in it
  std::optional<net::Payload> payload;    ///< already in it at t = 0
  std::optional<net::Delivery> delivery;  ///< where the payload must come to rest

  const vehicle::Model& model_of(const Robot& robot) const {
    return models[static_cast<std::size_t>(robot.model)];
  }
};

}  // namespace seine::world
