#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/geom/grid_check.hpp"
#include "seine/world/families.hpp"

namespace seine::world {
namespace {

using geom::OccupancyGrid;
using geom::Pose2;
using geom::Vec2;

constexpr double kPlaceClearance = 0.9;             // m from a rear axle: the whole footprint reaches 0.54 m
constexpr double kWayClearance = 0.5;               // m from the middle line of a way: a car is 0.4 m wide
constexpr double kRegion = 20.0;                    // m of driving around the team's anchor
constexpr double kShortest = 5.0, kLongest = 25.0;  // m of driving from start to goal
constexpr double kApart = 1.3;                      // m among starts, and among goals
constexpr double kLookAhead = 1.0;                  // m along the way that give a heading
constexpr double kHeadingSpread = 0.5;              // rad
constexpr int kAnchors = 300, kTriesPerRobot = 40;
constexpr float kFar = std::numeric_limits<float>::infinity();

/// Cells as one index; the neighbourhood, the distances and the random choices a team needs.
class Floor {
 public:
  explicit Floor(const OccupancyGrid& map) : map_(map), width_(map.width), clearance_(cells()) { measure(); }

  std::size_t cells() const { return map_.occupied.size(); }
  bool place(int cell) const { return clearance_[static_cast<std::size_t>(cell)] >= kPlaceClearance; }
  Vec2 center(int cell) const {
    const int column = cell % width_, row = cell / width_;
    return map_.origin * Vec2{(column + 0.5) * map_.resolution, (row + 0.5) * map_.resolution};
  }

  /// Driving distance from `from` to every cell within `limit`, infinity elsewhere; `order` lists the reached
  /// cells by distance.
  std::vector<float> distances(int from, double limit, std::vector<int>& order) const;
  /// The point about kLookAhead down the slope of `distance`.
  Vec2 downhill(const std::vector<float>& distance, int from) const;

 private:
  void measure();
  /// Calls visit(neighbour, length in metres) for the up to 8 neighbours that are part of a way.
  template <class Visit>
  void for_each_neighbour(int cell, Visit&& visit) const;

  const OccupancyGrid& map_;
  int width_;
  std::vector<float>
      clearance_;  // m to the nearest blocked cell's middle less half a diagonal, exact up to kPlaceClearance
};

void Floor::measure() {
  const int reach = static_cast<int>(std::ceil(kPlaceClearance / map_.resolution)) + 1;
  const float unit = static_cast<float>(map_.resolution), slack = 0.71F * unit;
  // Along rows first, then over rows: the nearest blocked cell is the nearest of each row's nearest.
  std::vector<int> across(cells(), reach + 1);
  for (int row = 0; row < map_.height; ++row) {
    const auto begin = across.begin() + static_cast<std::ptrdiff_t>(row) * width_;
    for (int pass = 0, since = 0; pass < 2; ++pass, since = 0) {  // the map's edge counts as blocked
      for (int i = 0; i < width_; ++i) {
        const int column = pass == 0 ? i : width_ - 1 - i;
        since = map_.blocked(column, row) ? 0 : since + 1;
        begin[column] = std::min(begin[column], since);
      }
    }
  }
  for (int row = 0; row < map_.height; ++row) {
    for (int column = 0; column < width_; ++column) {
      const int last = std::min(reach, std::min(row + 1, map_.height - row));
      int least = last * last;  // rows beyond the map are blocked
      for (int down = -last + 1; down < last; ++down) {
        const int side = across[static_cast<std::size_t>(row + down) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(column)];
        least = std::min(least, side * side + down * down);
      }
      clearance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column)] = unit * std::sqrt(static_cast<float>(least)) - slack;
    }
  }
}

template <class Visit>
void Floor::for_each_neighbour(int cell, Visit&& visit) const {
  const int column = cell % width_, row = cell / width_;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      if (map_.blocked(column + dx, row + dy)) continue;
      const int next = cell + dy * width_ + dx;
      if (clearance_[static_cast<std::size_t>(next)] < kWayClearance) continue;
      const double step = dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0;
      visit(next, static_cast<float>(step * map_.resolution));
    }
  }
}

std::vector<float> Floor::distances(int from, double limit, std::vector<int>& order) const {
  using Entry = std::pair<float, int>;
  std::vector<float> distance(cells(), kFar);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[static_cast<std::size_t>(from)] = 0.0F;
  open.emplace(0.0F, from);
  order.clear();
  while (!open.empty()) {
    const auto [reached, cell] = open.top();
    open.pop();
    if (reached > distance[static_cast<std::size_t>(cell)]) continue;
    order.push_back(cell);
    for_each_neighbour(cell, [&, base = reached](int next, float step) {
      float& best = distance[static_cast<std::size_t>(next)];
      if (base + step >= best || base + step > limit) return;
      best = base + step;
      open.emplace(best, next);
    });
  }
  return distance;
}

Vec2 Floor::downhill(const std::vector<float>& distance, int from) const {
  int cell = from;
  const float start = distance[static_cast<std::size_t>(from)];
  while (start - distance[static_cast<std::size_t>(cell)] < kLookAhead) {
    int best = cell;
    for_each_neighbour(cell, [&](int next, float) {
      if (distance[static_cast<std::size_t>(next)] < distance[static_cast<std::size_t>(best)]) best = next;
    });
    if (best == cell) break;
    cell = best;
  }
  return center(cell);
}

double heading_of(Vec2 way, Rng& rng) {
  return geom::wrap_angle(std::atan2(way.y, way.x) + rng.uniform(-kHeadingSpread, kHeadingSpread));
}

/// One more robot whose start and goal are among `places`; false when a handful of draws found none.
bool add_robot(Scenario& scenario, const Floor& floor, const std::vector<int>& places, Rng& rng) {
  const auto any = [&] {
    return places[static_cast<std::size_t>(rng.below(static_cast<int>(places.size())))];
  };
  const auto free = [&](int cell) {
    return std::all_of(scenario.robots.begin(), scenario.robots.end(), [&](const Robot& other) {
      return geom::norm(other.start.position() - floor.center(cell)) >= kApart &&
             geom::norm(other.goal->position() - floor.center(cell)) >= kApart;
    });
  };
  const int start = any();
  if (!free(start)) return false;
  std::vector<int> reached, back;
  const std::vector<float> from_start = floor.distances(start, kLongest, reached);
  for (int tries = 0; tries < kTriesPerRobot; ++tries) {
    const int goal = any();
    const float way = from_start[static_cast<std::size_t>(goal)];
    if (way < kShortest || way > kLongest || !free(goal)) continue;
    const std::vector<float> from_goal = floor.distances(goal, way + 0.1F, back);
    const Vec2 s = floor.center(start), g = floor.center(goal);
    const double leave = heading_of(floor.downhill(from_goal, start) - s, rng);
    const double arrive = heading_of(g - floor.downhill(from_start, goal), rng);
    scenario.robots.push_back({.name = "car" + std::to_string(scenario.robots.size()),
                               .start = {s.x, s.y, leave},
                               .goal = geom::Pose2{g.x, g.y, arrive}});
    return true;
  }
  return false;
}

}  // namespace

Scenario on_map(const OccupancyGrid& map, int robots, std::uint64_t seed) {
  if (!geom::is_complete(map)) throw InputError("the map has not the cells that its width and height say");
  if (robots < 1 || robots > 1000)
    throw InputError("a team on a map has 1 to 1000 robots, not " + std::to_string(robots));
  Scenario scenario;
  scenario.name = "map-" + std::to_string(robots) + "-" + std::to_string(seed);
  scenario.models = {standard_car()};
  scenario.bounds = map.box();
  scenario.map = map;
  const Floor floor(map);
  std::vector<int> everywhere;
  for (int cell = 0; cell < static_cast<int>(floor.cells()); ++cell) {
    if (floor.place(cell)) everywhere.push_back(cell);
  }
  Rng rng(seed);
  for (int anchor = 0; anchor < kAnchors && !everywhere.empty(); ++anchor) {
    std::vector<int> places;
    floor.distances(everywhere[static_cast<std::size_t>(rng.below(static_cast<int>(everywhere.size())))],
                    kRegion, places);
    std::erase_if(places, [&](int cell) { return !floor.place(cell); });
    scenario.robots.clear();
    for (int tries = 0; tries < 10 * robots && static_cast<int>(scenario.robots.size()) < robots; ++tries) {
      add_robot(scenario, floor, places, rng);
    }
    if (static_cast<int>(scenario.robots.size()) == robots) return scenario;
  }
  throw InputError("the map has no room for a team of " + std::to_string(robots));
}

}  // namespace seine::world
