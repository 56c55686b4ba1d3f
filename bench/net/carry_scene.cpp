#include "bench/net/carry_scene.hpp"

#include <cmath>
#include <numbers>

#include "seine/base/rng.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/search/point_distances.hpp"
#include "seine/world/check.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"
#include "seine/world/static_map.hpp"

namespace seine::bench {
namespace {

using geom::Vec2;

constexpr double kOpening = 0.86;
constexpr double kNarrow = 1.05;  // m, radius of the disc that must have a way: gaps of 2.1 m and more
constexpr double kRoom = 1.9;     // m around the middle of the net at the start and where it is delivered
constexpr double kShortest = 6.0, kLongest = 20.0;  // m of driving
constexpr int kTries = 4000;

bool is_free(const geom::OccupancyGrid& map, Vec2 point) {
  const Vec2 d = map.origin.direction(), from = point - map.origin.position();
  return !map.blocked(static_cast<int>(std::floor(geom::dot(from, d) / map.resolution)),
                      static_cast<int>(std::floor(geom::cross(d, from) / map.resolution)));
}

void place_team(world::Scenario& scenario, int robots, Vec2 middle, double heading, double turn) {
  const Vec2 ahead = scenario.net->attachments.front().at.x * geom::unit(heading);
  scenario.robots.clear();
  for (int k = 0; k < robots; ++k) {
    const Vec2 rest = scenario.net->rest[static_cast<std::size_t>(k)], spin = geom::unit(turn);
    const Vec2 at =
        middle + kOpening * Vec2{spin.x * rest.x - spin.y * rest.y, spin.y * rest.x + spin.x * rest.y};
    scenario.robots.push_back(
        {.name = "car" + std::to_string(k), .start = {at.x - ahead.x, at.y - ahead.y, heading}});
  }
}

}  // namespace

std::optional<world::Scenario> carry_scene(const geom::OccupancyGrid& map, int robots, std::uint64_t seed) {
  world::Scenario scenario;
  scenario.name = "carry-" + std::to_string(robots) + "-" + std::to_string(seed);
  scenario.map = map;
  scenario.bounds = map.box();
  scenario.models = {world::standard_car()};
  scenario.net = world::family_net(robots);
  scenario.payload = net::Payload{};
  const world::StaticMap walls(scenario);
  const search::PointDistances distances(walls, 0.25, 3.0);
  Rng rng(seed);
  const auto anywhere = [&] {
    return Vec2{rng.uniform(scenario.bounds.low.x, scenario.bounds.high.x),
                rng.uniform(scenario.bounds.low.y, scenario.bounds.high.y)};
  };
  for (int tries = 0; tries < kTries; ++tries) {
    const Vec2 from = anywhere();
    if (distances.bounds(from).lower < kRoom || !is_free(map, from)) continue;
    const Vec2 to = from + rng.uniform(kShortest, kLongest) * geom::unit(rng.uniform(-3.14, 3.14));
    if (distances.bounds(to).lower < kRoom || !is_free(map, to)) continue;
    search::CostToGo way({.distances = &distances, .radius = kNarrow}, to);
    way.focus(from);
    const double length = way(from);
    if (!(length < kLongest)) continue;
    // Off roughly downhill.
    double best = length, heading = 0.0;
    for (int i = 0; i < 16; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 16;
      const double left = way(from + 1.5 * geom::unit(angle));
      if (left < best) best = left, heading = angle;
    }
    place_team(scenario, robots, from, heading + rng.uniform(-0.4, 0.4), rng.uniform(-3.14, 3.14));
    scenario.delivery = net::Delivery{to, 0.5, {}};
    if (world::check(scenario, walls).empty()) return scenario;
  }
  return std::nullopt;
}

}  // namespace seine::bench
