#include <initializer_list>
#include <utility>

#include "seine/sim/car_signals.hpp"
#include "seine/sim/foxglove.hpp"

namespace seine::sim::foxglove {
namespace {

using Field = std::pair<const char*, std::string>;

const char* const kNumber = R"({"type":"number"})";
const char* const kInteger = R"({"type":"integer"})";
const char* const kText = R"({"type":"string"})";
const char* const kBoolean = R"({"type":"boolean"})";
const char* const kObjects = R"({"type":"array","items":{"type":"object"}})";

std::string object(const char* title, std::initializer_list<Field> fields) {
  JsonText json;
  json.open('{').field("title", title).field("type", "object").key("properties").open('{');
  for (const auto& [name, type] : fields) json.key(name).raw(type);
  json.close('}').key("required").open('[');
  for (const auto& [name, type] : fields) json.text(name);
  return json.close(']').close('}').str();
}

std::string array(const std::string& items) {
  return R"({"type":"array","items":)" + items + "}";
}

std::string time(const char* title) {
  return object(title, {{"sec", kInteger}, {"nsec", kInteger}});
}
std::string vector3() {
  return object("foxglove.Vector3", {{"x", kNumber}, {"y", kNumber}, {"z", kNumber}});
}
std::string point3() {
  return object("foxglove.Point3", {{"x", kNumber}, {"y", kNumber}, {"z", kNumber}});
}
std::string quaternion() {
  return object("foxglove.Quaternion", {{"x", kNumber}, {"y", kNumber}, {"z", kNumber}, {"w", kNumber}});
}
std::string pose() {
  return object("foxglove.Pose", {{"position", vector3()}, {"orientation", quaternion()}});
}
std::string color() {
  return object("foxglove.Color", {{"r", kNumber}, {"g", kNumber}, {"b", kNumber}, {"a", kNumber}});
}
std::string solid(const char* title) {
  return object(title, {{"pose", pose()}, {"size", vector3()}, {"color", color()}});
}
std::string line() {
  return object("foxglove.LinePrimitive", {{"type", kInteger},
                                           {"pose", pose()},
                                           {"thickness", kNumber},
                                           {"scale_invariant", kBoolean},
                                           {"points", array(point3())},
                                           {"color", color()},
                                           {"colors", array(color())},
                                           {"indices", array(kInteger)}});
}
std::string entity() {
  return object("foxglove.SceneEntity", {{"timestamp", time("time")},
                                         {"frame_id", kText},
                                         {"id", kText},
                                         {"lifetime", time("duration")},
                                         {"frame_locked", kBoolean},
                                         {"metadata", kObjects},
                                         {"arrows", kObjects},
                                         {"cubes", array(solid("foxglove.CubePrimitive"))},
                                         {"spheres", array(solid("foxglove.SpherePrimitive"))},
                                         {"cylinders", kObjects},
                                         {"lines", array(line())},
                                         {"triangles", kObjects},
                                         {"texts", kObjects},
                                         {"models", kObjects}});
}

}  // namespace

std::string scene_update_schema() {
  return object("foxglove.SceneUpdate", {{"deletions", kObjects}, {"entities", array(entity())}});
}

std::string frame_transform_schema() {
  return object("foxglove.FrameTransform", {{"timestamp", time("time")},
                                            {"parent_frame_id", kText},
                                            {"child_frame_id", kText},
                                            {"translation", vector3()},
                                            {"rotation", quaternion()}});
}

std::string log_schema() {
  return object("foxglove.Log", {{"timestamp", time("time")},
                                 {"level", kInteger},
                                 {"message", kText},
                                 {"name", kText},
                                 {"file", kText},
                                 {"line", kInteger}});
}

std::string car_schema() {
  JsonText json;
  json.open('{').field("title", "seine.Car").field("type", "object").key("properties").open('{');
  json.key("t").raw(kNumber).key("tracking_error").raw(kNumber);
  for (const Signal& signal : signals_of(CarRecord{})) json.key(signal.name).raw(kNumber);
  return json.close('}').close('}').str();
}

std::string target_schema() {
  JsonText json;
  json.open('{').field("title", "seine.Target").field("type", "object").key("properties").open('{');
  for (const char* name :
       {"t", "x", "y", "z", "vx", "vy", "vz", "seen_x", "seen_y", "seen_z", "estimate_x", "estimate_y",
        "estimate_z", "estimate_vx", "estimate_vy", "estimate_vz", "estimate_drag", "estimate_error"})
    json.key(name).raw(kNumber);
  return json.key("fate").raw(kText).key("touching").raw(kBoolean).close('}').close('}').str();
}

}  // namespace seine::sim::foxglove
