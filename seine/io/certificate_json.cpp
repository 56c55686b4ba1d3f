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

/// Kinds whose `other` is a robot too.
bool names_two_robots(certify::Kind kind) {
  return kind == certify::Kind::robot_clearance || kind == certify::Kind::net_stretch ||
         kind == certify::Kind::net_topology;
}

std::string catch_json(const net::Catch& caught) {
  JsonObject object;
  object.add("time_s", caught.time);
  object.add("margin_m", caught.rim_margin);
  object.add("opening", caught.opening);
  object.add("contact_margin_m", caught.contact_margin);
  object.add("depth_m", caught.depth);
  object.add("angle_rad", caught.angle);
  object.add("speed_m_s", caught.speed);
  object.add("bottom_m", caught.bottom);
  return object.line();
}

std::string catches_json(const certify::Certificate& certificate) {
  std::string out = "[";
  for (const net::Catch& caught : certificate.catches) {
    if (out.size() > 1) out += ", ";
    out += catch_json(caught);
  }
  out += "]";
  return out;
}

/// The one with the smallest margin at the rim; one that never happens is worse than all others.
const net::Catch& worst_catch(const certify::Certificate& certificate) {
  const net::Catch* worst = &certificate.catches.front();
  for (const net::Catch& caught : certificate.catches) {
    if (std::isnan(worst->rim_margin)) break;
    if (!(caught.rim_margin >= worst->rim_margin)) worst = &caught;
  }
  return *worst;
}

}  // namespace

void add_catches(const certify::Certificate& certificate, JsonObject& object) {
  if (certificate.catches.empty()) return;
  object.add_raw("catch", catch_json(worst_catch(certificate)));
  if (certificate.catches.size() > 1) object.add_raw("catches", catches_json(certificate));
}

std::string violations_json(const world::Scenario& scenario, const certify::Certificate& certificate) {
  std::string out = "[";
  for (const certify::Violation& violation : certificate.violations) {
    JsonObject object;
    object.add("kind", certify::name_of(violation.kind));
    object.add("time", violation.time);
    add_robot(scenario, "robot", violation.robot, object);
    if (names_two_robots(violation.kind)) add_robot(scenario, "other", violation.other, object);
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
  if (scenario.net) {
    const certify::NetRoom& room = certificate.net;
    object.add_raw("net_stretch", closest_json(scenario, room.stretch, true));
    object.add_raw("net_convexity", closest_json(scenario, room.convexity, true));
    object.add_raw("net_ground", closest_json(scenario, room.ground, false));
    object.add_raw("net_obstacles", closest_json(scenario, room.obstacles, false));
    object.add("net_holding_m2", room.holding.clearance);
  }
  if (!certificate.catches.empty()) object.add_raw("catches", catches_json(certificate));
  object.add_raw("violations", violations_json(scenario, certificate));
  return object.line();
}

void add_clearances(const certify::Certificate& certificate, JsonObject& object) {
  const double robots = certificate.robots.clearance, obstacles = certificate.obstacles.clearance;
  if (std::isfinite(robots)) object.add("min_robot_clearance_m", robots);
  if (std::isfinite(obstacles)) object.add("min_obstacle_clearance_m", obstacles);
  const double ground = certificate.net.ground.clearance, stretch = certificate.net.stretch.clearance;
  if (std::isfinite(ground)) object.add("min_net_clearance_m", ground);
  if (std::isfinite(stretch)) object.add("min_net_stretch_margin_m", stretch);
}

}  // namespace seine::io
