#include "seine/world/frame.hpp"

#include <algorithm>
#include <cmath>

namespace seine::world {
namespace {

constexpr double kFar = 1000.0;  // m
constexpr double kPerMetre = 1e7;

double snapped(double coordinate) {
  return std::round(coordinate * kPerMetre) / kPerMetre;
}

}  // namespace

std::optional<geom::Vec2> local_origin(const Scenario& scenario) {
  const geom::Vec2 middle = scenario.bounds.center();
  const double off = std::max(std::abs(middle.x), std::abs(middle.y));
  if (!(off > kFar) || !std::isfinite(off)) return std::nullopt;
  return geom::Vec2{snapped(middle.x), snapped(middle.y)};
}

Scenario seen_from(const Scenario& scenario, geom::Vec2 origin) {
  Scenario result = scenario;
  const auto move = [&](auto& place) {
    place.x = snapped(place.x - origin.x), place.y = snapped(place.y - origin.y);
  };
  move(result.bounds.low);
  move(result.bounds.high);
  if (result.map) move(result.map->origin);
  for (Obstacle& obstacle : result.obstacles) {
    for (Waypoint& waypoint : obstacle.motion) move(waypoint.pose);
    if (!obstacle.motion.empty()) continue;  // its shape is in a frame of its own
    if (auto* circle = std::get_if<Circle>(&obstacle.shape))
      move(circle->center);
    else
      for (geom::Vec2& vertex : std::get<std::vector<geom::Vec2>>(obstacle.shape)) move(vertex);
  }
  for (Robot& robot : result.robots) {
    move(robot.start);
    if (robot.goal) move(*robot.goal);
  }
  for (net::Target& target : result.targets) move(target.position);
  if (result.delivery) move(result.delivery->center);
  result.origin += origin;
  return result;
}

}  // namespace seine::world
