#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

#include "seine/geom/box.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/sim/car_signals.hpp"
#include "seine/sim/foxglove.hpp"

namespace seine::sim::foxglove {
namespace {

using geom::Vec2;
using geom::Vec3;

constexpr double kCarHeight = 0.25;  // m, as drawn
constexpr int kLineLoop = 1, kLineList = 2;
constexpr int kInfo = 2;

struct Color {
  double r, g, b, a;
};
constexpr Color kCarColor{0.20, 0.45, 0.75, 1.0}, kNetColor{0.25, 0.25, 0.25, 0.8},
    kBallColor{0.85, 0.30, 0.15, 1.0}, kObstacleColor{0.5, 0.5, 0.5, 1.0};

void put_time(JsonText& json, const char* name, double time) {
  const double seconds = std::floor(time);
  json.key(name).open('{').field("sec", seconds);
  json.field("nsec", std::min(999999999.0, std::round(1e9 * (time - seconds)))).close('}');
}

void put(JsonText& json, Vec3 v) {
  json.open('{').field("x", v.x).field("y", v.y).field("z", v.z).close('}');
}

void put_turn(JsonText& json, double heading) {
  json.open('{').field("x", 0.0).field("y", 0.0);
  json.field("z", std::sin(0.5 * heading)).field("w", std::cos(0.5 * heading)).close('}');
}

void put_pose(JsonText& json, Vec3 position, double heading) {
  json.key("pose").open('{').key("position");
  put(json, position);
  json.key("orientation");
  put_turn(json, heading);
  json.close('}');
}

void put(JsonText& json, const Color& c) {
  json.key("color").open('{').field("r", c.r).field("g", c.g).field("b", c.b).field("a", c.a).close('}');
}

void put_solid(JsonText& json, Vec3 position, double heading, Vec3 size, const Color& color) {
  json.open('{');
  put_pose(json, position, heading);
  json.key("size");
  put(json, size);
  put(json, color);
  json.close('}');
}

// What every entity has, up to the lists of primitives.
void open_entity(JsonText& json, const std::string& id, double time) {
  json.open('{');
  put_time(json, "timestamp", time);
  json.field("frame_id", "world").field("id", id);
  put_time(json, "lifetime", 0.0);
  json.key("frame_locked").boolean(false).key("metadata").raw("[]").key("arrows").raw("[]");
}

void close_entity(JsonText& json) {
  for (const char* none : {"triangles", "texts", "models"}) json.key(none).raw("[]");
  json.close('}');
}

void put_lines(JsonText& json, int type, std::span<const Vec3> points, std::span<const int> indices,
               const Color& color) {
  json.open('{').field("type", type);
  put_pose(json, {}, 0.0);
  json.field("thickness", 1.5).key("scale_invariant").boolean(true).key("points").open('[');
  for (const Vec3 point : points) put(json, point);
  json.close(']');
  put(json, color);
  json.key("colors").raw("[]").key("indices").open('[');
  for (const int index : indices) json.number(index);
  json.close(']').close('}');
}

void put_cars(JsonText& json, const world::Scenario& scenario, const Record& record) {
  open_entity(json, "cars", record.time);
  json.key("cubes").open('[');
  for (std::size_t k = 0; k < record.cars.size(); ++k) {
    const geom::Box box = geom::bounding_box(scenario.model_of(scenario.robots[k]).footprint);
    const geom::Pose2& pose = record.cars[k].truth.pose;
    const Vec2 middle = pose * (0.5 * (box.low + box.high));
    put_solid(json, {middle.x, middle.y, 0.5 * kCarHeight}, pose.heading,
              {box.size().x, box.size().y, kCarHeight}, kCarColor);
  }
  json.close(']').key("spheres").raw("[]").key("cylinders").raw("[]").key("lines").open('[');
  if (scenario.net) {  // the masts
    for (std::size_t k = 0; k < record.cars.size(); ++k) {
      const net::Attachment& held = scenario.net->attachments[k];
      const Vec2 at = record.cars[k].truth.pose * held.at;
      const Vec3 mast[] = {{at.x, at.y, 0.0}, {at.x, at.y, held.height}};
      put_lines(json, kLineList, mast, {}, kCarColor);
    }
  }
  json.close(']');
  close_entity(json);
}

void put_net(JsonText& json, const Record& record) {
  open_entity(json, "net", record.time);
  json.key("cubes").raw("[]").key("spheres").raw("[]").key("cylinders").raw("[]").key("lines").open('[');
  std::vector<int> indices;
  for (const Cord& cord : record.mesh->cords) indices.insert(indices.end(), {cord.a, cord.b});
  put_lines(json, kLineList, record.nodes, indices, kNetColor);
  json.close(']');
  close_entity(json);
}

void put_targets(JsonText& json, const Record& record) {
  open_entity(json, "targets", record.time);
  json.key("cubes").raw("[]").key("spheres").open('[');
  for (const TargetRecord& target : record.targets) {
    const double size = 2.0 * target.ball.radius;
    if (target.present) put_solid(json, target.ball.position, 0.0, {size, size, size}, kBallColor);
  }
  json.close(']').key("cylinders").raw("[]").key("lines").raw("[]");
  close_entity(json);
}

std::vector<Vec3> outline(const world::Obstacle& obstacle) {
  constexpr int kSides = 24;
  std::vector<Vec3> points;
  if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
    for (int i = 0; i < kSides; ++i) {
      const Vec2 p = circle->center + circle->radius * geom::unit(2.0 * std::numbers::pi * i / kSides);
      points.push_back({p.x, p.y, 0.0});
    }
  } else {
    for (const Vec2 p : std::get<std::vector<Vec2>>(obstacle.shape)) points.push_back({p.x, p.y, 0.0});
  }
  return points;
}

}  // namespace

std::string scene_update(const world::Scenario& scenario, const Record& record) {
  JsonText json;
  json.open('{').key("deletions").raw("[]").key("entities").open('[');
  put_cars(json, scenario, record);
  if (record.mesh != nullptr) put_net(json, record);
  if (!record.targets.empty()) put_targets(json, record);
  return json.close(']').close('}').str();
}

std::string surroundings(const world::Scenario& scenario) {
  JsonText json;
  json.open('{').key("deletions").raw("[]").key("entities").open('[');
  open_entity(json, "obstacles", 0.0);
  json.key("cubes").raw("[]").key("spheres").raw("[]").key("cylinders").raw("[]").key("lines").open('[');
  for (const world::Obstacle& obstacle : scenario.obstacles)
    if (obstacle.motion.empty()) put_lines(json, kLineLoop, outline(obstacle), {}, kObstacleColor);
  const geom::Box& b = scenario.bounds;
  const Vec3 bounds[] = {
      {b.low.x, b.low.y, 0.0}, {b.high.x, b.low.y, 0.0}, {b.high.x, b.high.y, 0.0}, {b.low.x, b.high.y, 0.0}};
  put_lines(json, kLineLoop, bounds, {}, kObstacleColor);
  json.close(']');
  close_entity(json);
  return json.close(']').close('}').str();
}

std::string frame_transform(const std::string& name, const geom::Pose2& pose, double time) {
  JsonText json;
  json.open('{');
  put_time(json, "timestamp", time);
  json.field("parent_frame_id", "world").field("child_frame_id", name).key("translation");
  put(json, Vec3{pose.x, pose.y, 0.0});
  json.key("rotation");
  put_turn(json, pose.heading);
  return json.close('}').str();
}

std::string log(const Note& note) {
  JsonText json;
  json.open('{');
  put_time(json, "timestamp", note.time);
  json.field("level", kInfo).field("message", note.text).field("name", "seine");
  return json.field("file", "").field("line", 0.0).close('}').str();
}

std::string car(const CarRecord& car, double time) {
  JsonText json;
  json.open('{').field("t", time);
  for (const Signal& signal : signals_of(car)) json.field(signal.name, signal.value);
  const double error = geom::norm(car.truth.pose.position() - car.reference.pose.position());
  return json.field("tracking_error", error).close('}').str();
}

std::string target(const TargetRecord& target, double time) {
  const Vec3 p = target.ball.position, v = target.ball.velocity;
  JsonText json;
  json.open('{').field("t", time).field("x", p.x).field("y", p.y).field("z", p.z);
  json.field("vx", v.x).field("vy", v.y).field("vz", v.z);
  if (target.seen)
    json.field("seen_x", target.seen->x).field("seen_y", target.seen->y).field("seen_z", target.seen->z);
  if (target.estimate) {
    const net::Target& e = *target.estimate;
    json.field("estimate_x", e.position.x)
        .field("estimate_y", e.position.y)
        .field("estimate_z", e.position.z);
    json.field("estimate_vx", e.velocity.x).field("estimate_vy", e.velocity.y);
    json.field("estimate_vz", e.velocity.z).field("estimate_drag", e.drag);
    json.field("estimate_error", std::sqrt(std::max(e.covariance[0][0], e.covariance[1][1])));
  }
  json.field("fate", name_of(target.fate));
  return json.key("touching").boolean(target.touching).close('}').str();
}

}  // namespace seine::sim::foxglove
