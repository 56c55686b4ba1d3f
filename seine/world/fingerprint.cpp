#include "seine/world/fingerprint.hpp"

#include <bit>
#include <cstddef>
#include <string_view>

namespace seine::world {
namespace {

/// FNV-1a over 64-bit words instead of bytes, each mixed first (the finaliser of splitmix64).
class Hash {
 public:
  void add(std::uint64_t word) {
    word ^= word >> 30, word *= 0xbf58476d1ce4e5b9U;
    word ^= word >> 27, word *= 0x94d049bb133111ebU;
    state_ = (state_ ^ (word ^ (word >> 31))) * 0x100000001b3U;
    state_ ^= state_ >> 29;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number + 0.0)); }  // −0 and 0 are one number
  void add_count(std::size_t count) { add(static_cast<std::uint64_t>(count)); }
  void add(bool flag) { add(std::uint64_t{flag ? 1U : 0U}); }
  void add(geom::Vec2 p) { add(p.x), add(p.y); }
  void add(geom::Vec3 p) { add(p.x), add(p.y), add(p.z); }
  void add(const geom::Pose2& pose) { add(pose.position()), add(pose.heading); }
  void add(const std::vector<geom::Vec2>& points) {
    add_count(points.size());
    for (const geom::Vec2 p : points) add(p);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  void add(std::string_view text) {
    add_count(text.size());
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      word = word << 8U | static_cast<unsigned char>(text[i]);
      if (i % 8 == 7 || i + 1 == text.size()) add(word), word = 0;
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

std::uint64_t robots_of(const Scenario& scenario) {
  Hash hash;
  for (const Robot& robot : scenario.robots) {
    hash.add(std::string_view(robot.name));
    hash.add(robot.start);
    hash.add(robot.start_speed);
    hash.add(robot.goal);
  }
  return hash.value();
}

std::uint64_t models_of(const Scenario& scenario) {
  Hash hash;
  for (const Robot& robot : scenario.robots) {
    const vehicle::Model& model = scenario.model_of(robot);
    const vehicle::Limits& l = model.limits;
    hash.add(model.footprint);
    for (const double number : {model.wheelbase, l.speed, l.reverse_speed, l.acceleration,
                                l.lateral_acceleration, l.steering, l.steering_rate})
      hash.add(number);
  }
  return hash.value();
}

std::uint64_t world_of(const Scenario& scenario) {
  Hash hash;
  hash.add(scenario.origin);
  hash.add(scenario.bounds.low), hash.add(scenario.bounds.high);
  for (const Obstacle& obstacle : scenario.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle.shape)) {
      hash.add(circle->center), hash.add(circle->radius);
    } else {
      hash.add(std::get<std::vector<geom::Vec2>>(obstacle.shape));
    }
    hash.add(obstacle.height);
    hash.add_count(obstacle.motion.size());
    for (const Waypoint& waypoint : obstacle.motion) hash.add(waypoint.t), hash.add(waypoint.pose);
  }
  return hash.value();
}

std::uint64_t map_of(const Scenario& scenario) {
  Hash hash;
  if (!scenario.map) return hash.value();
  const geom::OccupancyGrid& grid = *scenario.map;
  hash.add(static_cast<std::uint64_t>(grid.width)), hash.add(static_cast<std::uint64_t>(grid.height));
  hash.add(grid.resolution), hash.add(grid.origin), hash.add(scenario.outside_free);
  std::uint64_t word = 0;  // 64 cells
  for (std::size_t i = 0; i < grid.occupied.size(); ++i) {
    word = word << 1U | (grid.occupied[i] != 0 ? 1U : 0U);
    if (i % 64 == 63 || i + 1 == grid.occupied.size()) hash.add(word), word = 0;
  }
  return hash.value();
}

std::uint64_t net_of(const Scenario& scenario) {
  Hash hash;
  hash.add(scenario.net.has_value());
  if (const auto& net = scenario.net) {
    hash.add(net->rest);
    for (const net::Attachment& held : net->attachments) hash.add(held.at), hash.add(held.height);
    hash.add(net->stretch), hash.add(net->clearance), hash.add(net->rebound);
  }
  hash.add_count(scenario.targets.size());
  for (const net::Target& target : scenario.targets) {
    hash.add(target.time), hash.add(target.position), hash.add(target.velocity);
    hash.add(target.radius), hash.add(target.mass), hash.add(target.drag);
    for (const auto& row : target.covariance)
      for (const double entry : row) hash.add(entry);
  }
  hash.add(scenario.payload.has_value());
  if (const auto& payload = scenario.payload) hash.add(payload->radius), hash.add(payload->mass);
  hash.add(scenario.delivery.has_value());
  if (const auto& delivery = scenario.delivery)
    hash.add(delivery->center), hash.add(delivery->radius), hash.add(delivery->heading);
  return hash.value();
}

std::uint64_t margins_of(const Scenario& scenario) {
  Hash hash;
  hash.add(scenario.margins.robot), hash.add(scenario.margins.obstacle), hash.add(scenario.margins.leaving);
  return hash.value();
}

}  // namespace

Fingerprint fingerprint(const Scenario& scenario) {
  return {robots_of(scenario), models_of(scenario),  world_of(scenario),
          map_of(scenario),    margins_of(scenario), net_of(scenario)};
}

std::vector<std::string> differences(const Fingerprint& a, const Fingerprint& b) {
  std::vector<std::string> names;
  for (const FingerprintPart& part : kFingerprintParts)
    if (a.*part.value != b.*part.value) names.emplace_back(part.name);
  return names;
}

}  // namespace seine::world
