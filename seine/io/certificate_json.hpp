#pragma once

#include <string>

#include "seine/certify/certificate.hpp"
#include "seine/io/json_text.hpp"
#include "seine/world/scenario.hpp"

namespace seine::io {

/// {"holds": …, "seconds": …, "robot_clearance": {…}, "obstacle_clearance": {…}, "violations": […]} on one
/// line; for a team with a net also "net_stretch", "net_convexity", "net_ground", "net_obstacles" (what is
/// left of each), "net_holding_m2" and "catches".
std::string certificate_json(const world::Scenario& scenario, const certify::Certificate& certificate);

/// [{"kind": "speed", "time": …, "robot": name, "value": …, "limit": …, "text": …}, …]
std::string violations_json(const world::Scenario& scenario, const certify::Certificate& certificate);

/// Adds "catch": {time_s, margin_m, opening, …}, of several that with the smallest margin, and then all of
/// them as "catches" in the order of the targets. Nothing where there are none.
void add_catches(const certify::Certificate& certificate, JsonObject& object);

/// Adds min_robot_clearance_m and min_obstacle_clearance_m where they are finite; for a net what is left of
/// its height (min_net_clearance_m) and of its largest distances (min_net_stretch_margin_m).
void add_clearances(const certify::Certificate& certificate, JsonObject& object);

}  // namespace seine::io
