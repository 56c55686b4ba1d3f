#include <unordered_set>

#include "seine/io/scenario_file.hpp"
#include "seine/io/scenario_formats.hpp"

namespace seine::io {
namespace {

constexpr double kObstacleRadius = 0.8;  // m, obsRadius of the benchmark's configuration
constexpr double kBoundsSlack = 0.01;    // m, see bounds_of

geom::Pose2 read_pose(const YamlValue& value) {
  const std::vector<double> xyh = value.numbers(3, kCoordinate);
  // The benchmark drives forward along (cos yaw, −sin yaw): its yaw is clockwise.
  return {xyh[0], xyh[1], geom::wrap_angle(-xyh[2])};
}

/// The benchmark asks only that the rear axle stays in [0, W] × [0, H]. Here the whole footprint stays in the
/// bounds, which is stricter, so any plan that keeps them keeps the benchmark's rule. The slack is for starts
/// and goals at the edge: written with yaws like 1.57, their corners stick out by up to 1.6 mm. Poses that
/// stick out further widen the bounds.
geom::Box bounds_of(const world::Scenario& scenario, geom::Vec2 size) {
  geom::Box bounds{{0.0, 0.0}, size};
  const geom::Box axle_bounds = bounds;
  for (const world::Robot& robot : scenario.robots) {
    for (const geom::Pose2& pose : {robot.start, *robot.goal}) {
      if (!axle_bounds.contains(pose.position())) continue;
      for (const geom::Vec2 corner : scenario.model_of(robot).footprint) bounds.include(pose * corner);
    }
  }
  return bounds.inflated(kBoundsSlack);
}

}  // namespace

world::Scenario read_clmapf(const YamlValue& root, const std::string& name, const vehicle::Model& car,
                            Reading* reading) {
  const YamlMap top = root.map({"agents", "map"});
  world::Scenario scenario;
  scenario.name = name;
  scenario.models = {car};
  scenario.margins = {0.0, 0.0};
  std::unordered_set<std::string> names;
  for (const YamlValue& agent : top.at("agents").list(1, ScenarioCaps::kRobots)) {
    const YamlMap map = agent.map({"name", "start", "goal"});
    const auto given = map.find("name");
    world::Robot robot{.name = given ? given->text() : "agent" + std::to_string(scenario.robots.size()),
                       .start = read_pose(map.at("start")),
                       .goal = read_pose(map.at("goal"))};
    if (!names.insert(robot.name).second) agent.fail("is called '" + robot.name + "' like another agent");
    scenario.robots.push_back(std::move(robot));
    if (reading != nullptr) reading->robots.push_back({map.at("start").where(), map.at("goal").where()});
  }
  const YamlMap map = top.at("map").map({"dimensions", "obstacles"});
  const std::vector<double> size = map.at("dimensions").numbers(2, {1e-3, 1e6});
  const auto obstacles = map.find("obstacles");
  if (obstacles && !obstacles->is_null()) {
    for (const YamlValue& entry : obstacles->list(0, ScenarioCaps::kObstacles)) {
      const std::vector<YamlValue> parts = entry.list(2, 3);  // [x, y], and in CSDO's instances a radius
      const double x = parts[0].number(kCoordinate), y = parts[1].number(kCoordinate);
      const double radius = parts.size() == 3 ? parts[2].number(kSize) : kObstacleRadius;
      scenario.obstacles.push_back({.name = "obstacle " + std::to_string(scenario.obstacles.size() + 1),
                                    .shape = world::Circle{{x, y}, radius},
                                    .motion = {}});
    }
  }
  scenario.bounds = bounds_of(scenario, {size[0], size[1]});
  return scenario;
}

}  // namespace seine::io
