#include "seine/vehicle/model.hpp"

#include <algorithm>

namespace seine::vehicle {

double Model::length() const {
  return geom::bounding_box(footprint).size().x;
}

double Model::width() const {
  return geom::bounding_box(footprint).size().y;
}

double Model::reach() const {
  double reach = 0.0;
  for (const geom::Vec2 corner : footprint) reach = std::max(reach, geom::norm(corner));
  return reach;
}

std::vector<geom::Vec2> rectangle_footprint(double length, double width, double rear_overhang) {
  const double rear = -rear_overhang, front = length - rear_overhang, half = 0.5 * width;
  return {{rear, -half}, {front, -half}, {front, half}, {rear, half}};
}

Model clmapf_car() {
  constexpr double kWheelbase = 1.0, kTurningRadius = 3.0;
  return {.name = "clmapf",
          .footprint = rectangle_footprint(3.0, 2.0, 1.0),
          .wheelbase = kWheelbase,
          .limits = {.speed = 1.0,
                     .reverse_speed = 1.0,
                     .acceleration = 1.0,
                     .steering = std::atan(kWheelbase / kTurningRadius)}};
}

Model tpcap_car() {
  return {
      .name = "tpcap",
      .footprint = rectangle_footprint(2.8 + 0.96 + 0.929, 1.942, 0.929),
      .wheelbase = 2.8,
      .limits = {
          .speed = 2.5, .reverse_speed = 2.5, .acceleration = 1.0, .steering = 0.75, .steering_rate = 0.5}};
}

}  // namespace seine::vehicle
