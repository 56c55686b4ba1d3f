#include "seine/io/certificate_json.hpp"

#include <cmath>

namespace seine::io {
namespace {

/// Adds the name of robot `index`, unless there is none of that number.
void add_robot(const world::Scenario& scenario, const char* key, int index, JsonObject& object) {
  if (index < 0 || static_cast<std::size_t>(index) >= scenario.robots.size()) return;
  object.add(key, scenario.robots[static_cast<std::size_t>(index)].name);
}

/// @param pair whether `other` is a robot too
std::string closest_json(const world::Scenario& scenario, const certify::Closest& closest, bool pair) {
  JsonObject object;
  object.add("clearance", closest.clearance);
  if (!std::isfinite(closest.clearance)) return object.line();
  object.add("time", closest.time);
  add_robot(scenario, "robot", closest.robot, object);
  if (pair) add_robot(scenario, "other", closest.other, object);
  return object.line();
}

}  // namespace

std::string violations_json(const world::Scenario& scenario, const certify::Certificate& certificate) {
  std::string out = "[";
  for (const certify::Violation& violation : certificate.violations) {
    JsonObject object;
    object.add("kind", certify::name_of(violation.kind));
    object.add("time", violation.time);
    add_robot(scenario, "robot", violation.robot, object);
    if (violation.kind == certify::Kind::robot_clearance)
      add_robot(scenario, "other", violation.other, object);
    object.add("value", violation.value);
    object.add("limit", violation.limit);
    object.add("text", violation.text);
    if (out.size() > 1) out += ", ";
    out += object.line();
  }
  out += "]";
  return out;
}

std::string certificate_json(const world::Scenario& scenario, const certify::Certificate& certificate) {
  JsonObject object;
  object.add("holds", certificate.holds);
  object.add("seconds", certificate.seconds);
  object.add_raw("robot_clearance", closest_json(scenario, certificate.robots, true));
  object.add_raw("obstacle_clearance", closest_json(scenario, certificate.obstacles, false));
  object.add_raw("violations", violations_json(scenario, certificate));
  return object.line();
}

void add_clearances(const certify::Certificate& certificate, JsonObject& object) {
  const double robots = certificate.robots.clearance, obstacles = certificate.obstacles.clearance;
  if (std::isfinite(robots)) object.add("min_robot_clearance_m", robots);
  if (std::isfinite(obstacles)) object.add("min_obstacle_clearance_m", obstacles);
}

}  // namespace seine::io
