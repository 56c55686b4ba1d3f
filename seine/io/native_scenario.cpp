#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <unordered_set>

#include "seine/geom/convex.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/map_file.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/scenario_formats.hpp"
#include "seine/io/suggestion.hpp"
#include "seine/world/granted_speed.hpp"

namespace seine::io {
namespace {

using geom::Vec2;
using world::Obstacle;
using world::Scenario;

constexpr Range kRate{1e-3, 1e4};       // speeds and accelerations that let a car move
constexpr Range kSteering{1e-3, 1.5};   // rad; π/2 has no turning circle
constexpr Range kSideLimit{1e-3, 1e6};  // lateral acceleration, steering rate

Vec2 read_point(const YamlValue& value) {
  const std::vector<double> xy = value.numbers(2, kCoordinate);
  return {xy[0], xy[1]};
}

std::vector<Vec2> read_polygon(const YamlValue& value) {
  std::vector<Vec2> polygon;
  for (const YamlValue& point : value.list(3, ScenarioCaps::kPolygonVertices))
    polygon.push_back(read_point(point));
  return geom::without_repeats(std::move(polygon));
}

geom::Pose2 read_pose(const YamlMap& map) {
  return {map.at("x").number(kCoordinate), map.at("y").number(kCoordinate), map.at("heading").heading()};
}

/// The hull of a footprint that is convex but for rounding: of vertices on a straight side, and the like.
std::vector<Vec2> nearest_convex(const YamlValue& value, const std::vector<Vec2>& vertices) {
  constexpr double kRounding = 1e-6;  // m, how deep a vertex may lie inside the hull
  const std::vector<Vec2> hull = geom::convex_hull(vertices);
  for (const Vec2 p : vertices) {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
      depth = std::min(depth, geom::cross(edge, p - hull[i]) / geom::norm(edge));
    }
    if (depth > kRounding) value.fail("is not convex, expected a convex polygon");
  }
  return hull;
}

std::vector<Vec2> read_footprint(const YamlValue& value) {
  const YamlMap map = value.map({"length", "width", "rear_overhang", "polygon"});
  const std::optional<YamlValue> polygon = map.find("polygon");
  if (!polygon) {
    return vehicle::rectangle_footprint(map.number("length", kSize, 0.60), map.number("width", kSize, 0.40),
                                        map.number("rear_overhang", {-1e4, 1e4}, 0.10));
  }
  if (map.entries().size() > 1)
    value.fail("has both a polygon and sides of a rectangle, expected one of them");
  std::vector<Vec2> vertices;
  for (const YamlValue& point : polygon->list(3, 100)) vertices.push_back(read_point(point));
  vertices = geom::without_repeats(std::move(vertices));
  const std::string wrong = geom::why_not_simple(vertices);
  if (!wrong.empty()) polygon->fail("is not simple: " + wrong);
  if (geom::signed_area(vertices) < 0) std::reverse(vertices.begin(), vertices.end());
  return geom::is_convex(vertices) ? vertices : nearest_convex(*polygon, vertices);
}

vehicle::Limits read_limits(const YamlValue& value, vehicle::Limits limits) {
  const YamlMap map = value.map(
      {"speed", "reverse_speed", "acceleration", "lateral_acceleration", "steering", "steering_rate"});
  limits.speed = map.number("speed", kRate, limits.speed);
  limits.reverse_speed = map.number("reverse_speed", {0.0, kRate.high}, limits.reverse_speed);
  limits.acceleration = map.number("acceleration", kRate, limits.acceleration);
  if (const auto steering = map.find("steering")) limits.steering = steering->angle(kSteering);
  if (const auto lateral = map.find("lateral_acceleration")) {
    limits.lateral_acceleration = lateral->number_or_infinity(kSideLimit);
  }
  if (const auto rate = map.find("steering_rate"))
    limits.steering_rate = rate->number_or_infinity(kSideLimit);
  return limits;
}

/// The model that a file without `models` uses, and that lends every key a model leaves out.
vehicle::Model default_model() {
  vehicle::Model model{
      .name = "default", .footprint = vehicle::rectangle_footprint(0.60, 0.40, 0.10), .limits = {}};
  model.limits.lateral_acceleration = 3.0;
  return model;
}

std::vector<world::Waypoint> read_motion(const YamlValue& value, std::size_t& vertices_left) {
  std::vector<world::Waypoint> motion;
  for (const YamlValue& entry : value.list(1, vertices_left)) {
    const YamlMap map = entry.map({"t", "x", "y", "heading"});
    const geom::Pose2 pose{map.at("x").number(kCoordinate), map.at("y").number(kCoordinate),
                           map.has("heading") ? map.at("heading").heading() : 0.0};
    motion.push_back({map.at("t").number({-1e6, 1e6}), pose});
    if (motion.size() > 1 && motion.back().t <= motion[motion.size() - 2].t) {
      entry.fail("has a time that is not after the one before, expected growing times");
    }
  }
  vertices_left -= motion.size();
  return motion;
}

world::Circle read_circle(const YamlValue& value, bool moving) {
  const YamlMap map = value.map({"center", "radius"});
  world::Circle circle{{}, map.at("radius").number(kSize)};
  const std::optional<YamlValue> center = map.find("center");
  if (center) circle.center = read_point(*center);
  if (!center && !moving) value.fail("has no 'center', which is required for a circle without motion");
  // Where a moving circle is, its motion says: its body frame is its centre.
  if (moving) circle.center = {};
  return circle;
}

Obstacle read_obstacle(const YamlValue& value, std::size_t number, std::size_t& vertices_left) {
  const YamlMap map = value.map({"name", "polygon", "circle", "height", "motion"});
  const auto polygon = map.find("polygon"), circle = map.find("circle"), motion = map.find("motion");
  if (polygon.has_value() == circle.has_value()) value.fail("expected one of 'polygon' and 'circle'");
  Obstacle obstacle;
  const auto name = map.find("name");
  obstacle.name = name ? name->text() : "obstacle " + std::to_string(number);
  if (const auto height = map.find("height")) obstacle.height = height->number_or_infinity(kSize);
  if (motion) obstacle.motion = read_motion(*motion, vertices_left);
  if (circle) {
    obstacle.shape = read_circle(*circle, motion.has_value());
    return obstacle;
  }
  std::vector<Vec2> vertices = read_polygon(*polygon);
  if (vertices.size() > vertices_left) {
    polygon->fail("is one too many, expected at most " + std::to_string(ScenarioCaps::kVertices) +
                  " vertices and waypoints in all");
  }
  vertices_left -= vertices.size();
  const std::string wrong = geom::why_not_simple(vertices);
  if (!wrong.empty()) polygon->fail("is not simple: " + wrong);
  obstacle.shape = std::move(vertices);
  return obstacle;
}

/// What lies outside the map's picture.
bool read_outside(const YamlValue& value, const Scenario& scenario) {
  if (!scenario.map) value.fail("says what lies outside the map, but there is no 'map'");
  const std::string text = value.text();
  if (text != "unknown" && text != "free") value.fail("is '" + text + "', expected unknown or free");
  return text == "free";
}

void read_world(const YamlValue& value, const std::filesystem::path& folder, Scenario& scenario,
                Reading* reading) {
  const YamlMap map = value.map({"bounds", "map", "outside", "obstacles"});
  if (const auto file = map.find("map"); file && !file->is_null())
    scenario.map = load_map(referred_file(*file, folder), reading);
  if (const auto outside = map.find("outside")) scenario.outside_free = read_outside(*outside, scenario);
  if (const auto bounds = map.find("bounds")) {
    const std::vector<double> b = bounds->numbers(4, kCoordinate);
    scenario.bounds = {{b[0], b[1]}, {b[2], b[3]}};
    if (b[0] >= b[2] || b[1] >= b[3]) bounds->fail("are empty, expected [xmin, ymin, xmax, ymax]");
    if (std::max(b[2] - b[0], b[3] - b[1]) > kWidestWorld)
      bounds->fail("are wider than 2000 km, expected a smaller world");
  } else if (scenario.map) {
    scenario.bounds = scenario.map->box();
  } else {
    value.fail("has neither 'bounds' nor 'map', expected bounds: [xmin, ymin, xmax, ymax]");
  }
  const auto obstacles = map.find("obstacles");
  if (!obstacles || obstacles->is_null()) return;
  std::size_t vertices_left = ScenarioCaps::kVertices;
  for (const YamlValue& entry : obstacles->list(0, ScenarioCaps::kObstacles)) {
    scenario.obstacles.push_back(read_obstacle(entry, scenario.obstacles.size() + 1, vertices_left));
  }
}

int find_model(const Scenario& scenario, const YamlMap& robot) {
  const auto value = robot.find("model");
  const std::string wanted = value ? value->text() : "default";
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < scenario.models.size(); ++i) {
    if (scenario.models[i].name == wanted) return static_cast<int>(i);
    known.push_back(scenario.models[i].name);
  }
  const YamlValue& place = value ? *value : robot.self();
  place.fail((value ? "is '" + wanted + "'" : "names no model and there is none called 'default'") +
             ", expected a model of 'models'" + did_you_mean(wanted, known));
}

world::Robot read_robot(const YamlValue& value, std::size_t index, const Scenario& scenario, bool net,
                        Reading::Ends& ends) {
  const YamlMap map = value.map({"name", "model", "start", "goal"});
  world::Robot robot;
  const auto name = map.find("name");
  robot.name = name ? name->text() : "car" + std::to_string(index);
  robot.model = find_model(scenario, map);
  const YamlMap start = map.at("start").map({"x", "y", "heading", "speed"});
  robot.start = read_pose(start);
  ends = {start.self().where(), value.where()};
  robot.start_speed = start.number("speed", {-1e4, 1e4}, 0.0);
  const vehicle::Limits& limits = scenario.model_of(robot).limits;
  const std::optional<double> granted = world::granted_speed(limits, robot.start_speed);
  if (!granted) {
    start.at("speed").fail(
        joined("is ", number_text(robot.start_speed), ", beyond what the model can drive: ",
               number_text(limits.reverse_speed > 0.0 ? -limits.reverse_speed : 0.0), " to ",
               number_text(limits.speed), " m/s, and 1 % more for measured speeds"));
  }
  robot.start_speed = *granted;
  const auto goal = map.find("goal");
  if (goal) robot.goal = read_pose(goal->map({"x", "y", "heading"})), ends.goal = goal->where();
  if (!goal && !net) value.fail("has no 'goal', which is required for a team without a net");
  return robot;
}

/// @param net whether the team holds one: its robots may lack goals
void read_robots(const YamlValue& value, Scenario& scenario, bool net, Reading* reading) {
  std::unordered_set<std::string> names;
  for (const YamlValue& entry : value.list(1, ScenarioCaps::kRobots)) {
    Reading::Ends ends;
    scenario.robots.push_back(read_robot(entry, scenario.robots.size(), scenario, net, ends));
    if (reading != nullptr) reading->robots.push_back(std::move(ends));
    const std::string& name = scenario.robots.back().name;
    if (!names.insert(name).second)
      entry.fail("is called '" + name + "' like another robot, expected distinct names");
  }
}

}  // namespace

vehicle::Model read_model(const std::string& name, const YamlValue& value) {
  const YamlMap map = value.map({"footprint", "wheelbase", "limits"});
  vehicle::Model model = default_model();
  model.name = name;
  if (const auto footprint = map.find("footprint")) model.footprint = read_footprint(*footprint);
  model.wheelbase = map.number("wheelbase", kSize, model.wheelbase);
  if (const auto limits = map.find("limits")) model.limits = read_limits(*limits, model.limits);
  return model;
}

std::vector<vehicle::Model> read_models(const std::optional<YamlValue>& value) {
  if (!value) return {default_model()};
  const YamlMap map = value->open_map();
  if (map.entries().empty() || map.entries().size() > ScenarioCaps::kModels) {
    value->fail("has " + std::to_string(map.entries().size()) + " entries, expected 1 to " +
                std::to_string(ScenarioCaps::kModels));
  }
  std::vector<vehicle::Model> models;
  for (const auto& [name, model] : map.entries()) models.push_back(read_model(name, model));
  return models;
}

MarginChanges read_margins(const YamlValue& value) {
  const YamlMap map = value.map({"robot", "obstacle", "leaving"});
  const auto read = [&](std::string_view key) {
    const auto given = map.find(key);
    return given ? std::optional(given->number(kMargin)) : std::nullopt;
  };
  return {read("robot"), read("obstacle"), read("leaving")};
}

std::filesystem::path referred_file(const YamlValue& value, const std::filesystem::path& folder) {
  std::filesystem::path path = folder / value.text();
  if (const std::string why = why_unreadable(path); !why.empty())
    value.fail(joined("is '", value.text(), "', which cannot be read: ", why));
  return path;
}

void expect_version(const YamlMap& top) {
  const YamlValue version = top.at("seine");
  if (version.integer(0, 1000000) != 1) version.fail("is a format this version cannot read, expected 1");
}

Scenario read_native(const YamlValue& root, const std::string& name, const std::filesystem::path& folder,
                     Reading* reading) {
  const YamlMap top = root.map(
      {"seine", "name", "world", "models", "margins", "robots", "net", "targets", "payload", "delivery"});
  expect_version(top);
  Scenario scenario;
  const auto given_name = top.find("name");
  scenario.name = given_name ? given_name->text() : name;
  read_world(top.at("world"), folder, scenario, reading);
  scenario.models = read_models(top.find("models"));
  if (const auto value = top.find("margins")) {
    const MarginChanges margins = read_margins(*value);
    scenario.margins.robot = margins.robot.value_or(scenario.margins.robot);
    scenario.margins.obstacle = margins.obstacle.value_or(scenario.margins.obstacle);
    scenario.margins.leaving = margins.leaving;
  }
  read_robots(top.at("robots"), scenario, top.has("net"), reading);
  read_net_keys(top, scenario);
  return scenario;
}

}  // namespace seine::io
