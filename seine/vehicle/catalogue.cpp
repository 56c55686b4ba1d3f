#include "seine/vehicle/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace seine::vehicle {
namespace {

/// Outside dimensions, metres.
struct Body {
  double length, width;
  double rear_overhang;  ///< from the frame's axle to the rear end
  double wheelbase;
};

Model vehicle(const char* name, const Body& body, const Limits& limits) {
  return {.name = name,
          .footprint = rectangle_footprint(body.length, body.width, body.rear_overhang),
          .wheelbase = body.wheelbase,
          .limits = limits};
}

/// Steering angle of a turning radius at the frame's axle.
double steering_for(double wheelbase, double radius) {
  return std::atan(wheelbase / radius);
}

Model small_ackermann() {
  return vehicle("small-ackermann", {0.25, 0.18, 0.045, 0.16},
                 {.speed = 0.5, .reverse_speed = 0.5, .acceleration = 1.0, .steering = 0.5});
}

Model f1tenth() {
  return vehicle("f1tenth", {0.58, 0.31, 0.125, 0.3302},
                 {.speed = 7.0,
                  .reverse_speed = 2.0,
                  .acceleration = 5.0,
                  .lateral_acceleration = 8.0,
                  .steering = 0.4189,
                  .steering_rate = 3.2});
}

Model rc_car() {
  return vehicle(
      "rc-1-10", {0.568, 0.296, 0.12, 0.324},
      {.speed = 3.0, .reverse_speed = 1.5, .acceleration = 3.0, .steering = 0.37, .steering_rate = 4.0});
}

Model letter_car() {
  return vehicle("letter", {0.6, 0.4, 0.1, 0.4}, {.lateral_acceleration = 3.0});
}

Model hunter() {
  return vehicle("hunter", {0.98, 0.745, 0.165, 0.65},
                 {.speed = 1.5,
                  .reverse_speed = 1.5,
                  .acceleration = 1.0,
                  .steering = steering_for(0.65, 1.6),
                  .steering_rate = 0.7});
}

Model golf_cart() {
  return vehicle("golf-cart", {2.34, 1.2, 0.35, 1.65},
                 {.speed = 5.0,
                  .reverse_speed = 2.0,
                  .acceleration = 1.0,
                  .lateral_acceleration = 2.0,
                  .steering = steering_for(1.65, 2.9),
                  .steering_rate = 0.6});
}

Model forklift() {
  return vehicle("forklift", {2.9, 1.06, 1.55, 1.25},
                 {.speed = 4.0,
                  .reverse_speed = 4.0,
                  .acceleration = 1.0,
                  .lateral_acceleration = 1.5,
                  .steering = 1.2,
                  .steering_rate = 1.0});
}

Model csdo_car() {
  Model model = clmapf_car();
  model.name = "csdo";
  return model;
}

Model escort() {
  return vehicle("commonroad-1", {4.298, 1.674, 0.9, 2.391},
                 {.speed = 20.0,
                  .reverse_speed = 5.0,
                  .acceleration = 4.0,
                  .lateral_acceleration = 4.0,
                  .steering = 0.91});
}

Model bmw() {
  return vehicle("commonroad-2", {4.508, 1.61, 0.96, 2.579},
                 {.speed = 20.0,
                  .reverse_speed = 5.0,
                  .acceleration = 4.0,
                  .lateral_acceleration = 4.0,
                  .steering = 0.8,
                  .steering_rate = 0.4});
}

Model autoware() {
  return vehicle("autoware", {4.89, 1.896, 1.1, 2.79},
                 {.speed = 11.1,
                  .reverse_speed = 2.8,
                  .acceleration = 2.0,
                  .lateral_acceleration = 2.5,
                  .steering = 0.7,
                  .steering_rate = 0.5});
}

Model truck() {
  return vehicle("truck-12m", {12.0, 2.55, 3.2, 6.1},
                 {.speed = 13.9,
                  .reverse_speed = 2.8,
                  .acceleration = 1.2,
                  .lateral_acceleration = 2.0,
                  .steering = 0.7,
                  .steering_rate = 0.4});
}

}  // namespace

std::span<const CatalogueEntry> catalogue() {
  static const std::array entries{
      CatalogueEntry{small_ackermann(), "size of a TurtleBot3 with Ackermann steering [speed, steering]"},
      CatalogueEntry{rc_car(),
                     "1:10 short-course car, 568 x 296 mm, wheelbase 324 mm [speed, steering rate]"},
      CatalogueEntry{
          f1tenth(),
          "F1TENTH Gym's default parameters: 0.58 x 0.31 m, wheelbase 0.3302 m, steering 0.4189 rad "
          "and 3.2 rad/s [7 m/s, 5 m/s2]"},
      CatalogueEntry{letter_car(), "standard car of this project, after the letter's experiments [Pei24]"},
      CatalogueEntry{
          hunter(),
          "AgileX Hunter 2.0 manual: 980 x 745 mm, wheelbase 650 mm, turning radius 1.6 m, 1.5 m/s "
          "[acceleration, steering rate]"},
      CatalogueEntry{golf_cart(), "two-seat golf cart, 2.34 x 1.2 m, wheelbase 1.65 m [limits]"},
      CatalogueEntry{forklift(), "1.5 t counterbalance truck, rear-steered, without its load [limits]"},
      CatalogueEntry{csdo_car(),
                     "CL-MAPF benchmark [Wen22], which CSDO uses too: 3 x 2 m, turning radius 3 m"},
      CatalogueEntry{escort(),
                     "CommonRoad vehicle 1 (Ford Escort) [Althoff17], no steering rate [20 m/s, 4 m/s2]"},
      CatalogueEntry{bmw(),
                     "CommonRoad vehicle 2 (BMW 320i) [Althoff17]: 4.508 x 1.610 m, steering rate 0.4 rad/s "
                     "[20 m/s, 4 m/s2, steering 0.8 rad]"},
      CatalogueEntry{
          autoware(),
          "Autoware's sample vehicle: wheelbase 2.79 m, overhangs 1.0 and 1.1 m, steering 0.70 rad "
          "[40 km/h, accelerations]"},
      CatalogueEntry{truck(), "longest rigid lorry of Directive 96/53/EC, 12.0 x 2.55 m [wheelbase, limits]"},
  };
  return entries;
}

const Model* catalogued(std::string_view name) {
  const auto entries = catalogue();
  const auto at = std::find_if(entries.begin(), entries.end(),
                               [&](const CatalogueEntry& entry) { return entry.model.name == name; });
  return at == entries.end() ? nullptr : &at->model;
}

}  // namespace seine::vehicle
