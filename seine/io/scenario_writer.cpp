#include <algorithm>

#include "seine/io/file_bytes.hpp"
#include "seine/io/map_file.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/yaml_text.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

std::string point_text(Vec2 p) {
  return joined("[", number_text(p.x), ", ", number_text(p.y), "]");
}

std::string polygon_text(const std::vector<Vec2>& polygon) {
  std::string out = "[";
  for (const Vec2 p : polygon) out += (out.size() > 1 ? ", " : "") + point_text(p);
  return out + "]";
}

std::string pose_text(const geom::Pose2& pose) {
  return joined("x: ", number_text(pose.x), ", y: ", number_text(pose.y),
                ", heading: ", number_text(pose.heading));
}

std::string footprint_text(const std::vector<Vec2>& footprint) {
  if (footprint.size() == 4) {
    const double length = footprint[1].x - footprint[0].x, width = footprint[2].y - footprint[1].y;
    // Only where the short form gives back the very same bits.
    if (footprint == vehicle::rectangle_footprint(length, width, -footprint[0].x)) {
      return joined("{length: ", number_text(length), ", width: ", number_text(width),
                    ", rear_overhang: ", number_text(-footprint[0].x), "}");
    }
  }
  return joined("{polygon: ", polygon_text(footprint), "}");
}

std::string model_text(const vehicle::Model& model) {
  const vehicle::Limits& limits = model.limits;
  return joined("  ", yaml_scalar(model.name), ":\n    footprint: ", footprint_text(model.footprint),
                "\n    wheelbase: ", number_text(model.wheelbase),
                "\n    limits: {speed: ", number_text(limits.speed),
                ", reverse_speed: ", number_text(limits.reverse_speed),
                ", acceleration: ", number_text(limits.acceleration),
                ", lateral_acceleration: ", number_text(limits.lateral_acceleration),
                ", steering: ", number_text(limits.steering),
                ", steering_rate: ", number_text(limits.steering_rate), "}\n");
}

std::string shape_text(const world::Obstacle& obstacle) {
  if (const auto* polygon = std::get_if<std::vector<Vec2>>(&obstacle.shape))
    return joined("polygon: ", polygon_text(*polygon));
  world::Circle circle = std::get<world::Circle>(obstacle.shape);
  if (!obstacle.motion.empty()) {
    if (!(circle.center == Vec2{})) {
      throw InputError(obstacle.name +
                       ": moves about a point that is not its centre, which the format cannot express");
    }
    circle.center = obstacle.motion.front().pose.position();
  }
  return joined("circle: {center: ", point_text(circle.center), ", radius: ", number_text(circle.radius),
                "}");
}

std::string obstacle_text(const world::Obstacle& obstacle, std::size_t number) {
  std::string out = "    - {";
  if (obstacle.name != joined("obstacle ", number)) out += joined("name: ", yaml_scalar(obstacle.name), ", ");
  out += shape_text(obstacle);
  if (obstacle.height != std::numeric_limits<double>::infinity())
    out += joined(", height: ", number_text(obstacle.height));
  std::string motion;
  for (const world::Waypoint& waypoint : obstacle.motion) {
    motion += (motion.empty() ? "" : ", ") + (joined("{t: ", number_text(waypoint.t))) + ", " +
              pose_text(waypoint.pose) + "}";
  }
  if (!motion.empty()) out += joined(", motion: [", motion, "]");
  return out + "}\n";
}

std::string robot_text(const world::Scenario& scenario, const world::Robot& robot) {
  const std::string& model = scenario.model_of(robot).name;
  const std::string speed =
      robot.start_speed != 0.0 ? joined(", speed: ", number_text(robot.start_speed)) : "";
  const std::string goal = robot.goal ? joined(", goal: {", pose_text(*robot.goal), "}") : "";
  return joined("  - {name: ", yaml_scalar(robot.name),
                (model != "default" ? joined(", model: ", yaml_scalar(model)) : ""), ", start: {",
                pose_text(robot.start), speed, "}", goal, "}\n");
}

std::string vector_text(geom::Vec3 v) {
  return joined("[", number_text(v.x), ", ", number_text(v.y), ", ", number_text(v.z), "]");
}

std::string attachment_text(const net::Attachment& a) {
  return joined("{x: ", number_text(a.at.x), ", y: ", number_text(a.at.y), ", z: ", number_text(a.height),
                "}");
}

std::string net_text(const net::Net& net) {
  const auto same = [&](const net::Attachment& a) {
    return a.at == net.attachments[0].at && a.height == net.attachments[0].height;
  };
  std::string attachments;
  if (std::all_of(net.attachments.begin(), net.attachments.end(), same)) {
    attachments = attachment_text(net.attachments[0]);
  } else {
    for (const net::Attachment& a : net.attachments)
      attachments += (attachments.empty() ? "[" : ", ") + attachment_text(a);
    attachments += "]";
  }
  return joined("net:\n  rest: ", polygon_text(net.rest), "\n  attachment: ", attachments,
                "\n  stretch: ", number_text(net.stretch), "\n  clearance: ", number_text(net.clearance),
                "\n  rebound: ", number_text(net.rebound), "\n");
}

std::string covariance_text(const net::Target& target) {
  std::string out;
  for (const auto& row : target.covariance) {
    std::string line;
    for (const double entry : row) line += (line.empty() ? "[" : ", ") + number_text(entry);
    out += (out.empty() ? "[" : ", ") + line + "]";
  }
  return out + "]";
}

std::string target_text(const net::Target& target) {
  std::string out =
      joined("  - {time: ", number_text(target.time), ", position: ", vector_text(target.position),
             ", velocity: ", vector_text(target.velocity), ", radius: ", number_text(target.radius),
             ", mass: ", number_text(target.mass));
  if (target.drag != 0.0) out += joined(", drag: ", number_text(target.drag));
  if (target.covariance != decltype(target.covariance){})
    out += joined(", covariance: ", covariance_text(target));
  return out + "}\n";
}

std::string net_keys_text(const world::Scenario& scenario) {
  std::string out;
  if (scenario.net) out += net_text(*scenario.net);
  if (!scenario.targets.empty()) out += "targets:\n";
  for (const net::Target& target : scenario.targets) out += target_text(target);
  if (const auto& payload = scenario.payload) {
    out += joined("payload: {radius: ", number_text(payload->radius), ", mass: ", number_text(payload->mass),
                  "}\n");
  }
  if (const auto& delivery = scenario.delivery) {
    out += joined("delivery: {center: ", point_text(delivery->center),
                  ", radius: ", number_text(delivery->radius));
    if (delivery->heading) out += joined(", heading: ", number_text(*delivery->heading));
    out += "}\n";
  }
  return out;
}

}  // namespace

std::string scenario_text(const world::Scenario& scenario, const std::string& map_file) {
  const geom::Box& bounds = scenario.bounds;
  std::string out = joined("seine: 1\nname: ", yaml_scalar(scenario.name), "\nworld:\n  bounds: [",
                           number_text(bounds.low.x), ", ", number_text(bounds.low.y), ", ",
                           number_text(bounds.high.x), ", ", number_text(bounds.high.y), "]\n");
  if (!map_file.empty()) {
    out += joined("  map: ", yaml_scalar(map_file), "\n");
    if (scenario.outside_free) out += "  outside: free\n";
  }
  if (!scenario.obstacles.empty()) out += "  obstacles:\n";
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    out += obstacle_text(scenario.obstacles[i], i + 1);
  out += "models:\n";
  for (const vehicle::Model& model : scenario.models) out += model_text(model);
  out +=
      joined("margins: {robot: ", number_text(scenario.margins.robot),
             ", obstacle: ", number_text(scenario.margins.obstacle),
             (scenario.margins.leaving ? joined(", leaving: ", number_text(*scenario.margins.leaving)) : ""),
             "}\nrobots:\n");
  for (const world::Robot& robot : scenario.robots) out += robot_text(scenario, robot);
  return out + net_keys_text(scenario);
}

std::vector<std::filesystem::path> saved_files(const world::Scenario& scenario,
                                               const std::filesystem::path& path) {
  if (!scenario.map) return {path};
  const std::filesystem::path map = path.parent_path() / (path.stem().string() + "-map.yaml");
  return {path, map, std::filesystem::path(map).replace_extension(".pgm")};
}

void save_scenario(const world::Scenario& scenario, const std::filesystem::path& path) {
  std::filesystem::path map;
  if (scenario.map) {
    map = saved_files(scenario, path)[1];
    save_map(*scenario.map, map);
  }
  write_file(path, scenario_text(scenario, map.filename().string()));
}

}  // namespace seine::io
