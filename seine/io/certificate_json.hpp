#pragma once

#include <string>

#include "seine/certify/certificate.hpp"
#include "seine/io/json_text.hpp"
#include "seine/world/scenario.hpp"

namespace seine::io {

/// {"holds": …, "seconds": …, "robot_clearance": {…}, "obstacle_clearance": {…}, "violations": […]} on one
/// line.
std::string certificate_json(const world::Scenario& scenario, const certify::Certificate& certificate);

/// [{"kind": "speed", "time": …, "robot": name, "value": …, "limit": …, "text": …}, …]
std::string violations_json(const world::Scenario& scenario, const certify::Certificate& certificate);

/// Adds min_robot_clearance_m and min_obstacle_clearance_m where they are finite.
void add_clearances(const certify::Certificate& certificate, JsonObject& object);

}  // namespace seine::io
