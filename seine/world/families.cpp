#include "seine/world/families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/world/clutter.hpp"

namespace seine::world {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr double kPi = std::numbers::pi;
constexpr int kMostRobots = 10000;
constexpr double kApart = 1.3;  // m between the rear axles of two starts, or of two goals

constexpr std::array kFamilies{Family::random, Family::swap, Family::corridor, Family::parking};

/// An empty world with the standard car, named after what it is.
Scenario blank(Family family, int robots, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = std::string(name_of(family)) + "-" + std::to_string(robots) + "-" + std::to_string(seed);
  scenario.models = {standard_car()};
  return scenario;
}

void add_robot(Scenario& scenario, const Pose2& start, const Pose2& goal) {
  scenario.robots.push_back(
      {.name = "car" + std::to_string(scenario.robots.size()), .start = start, .goal = goal});
}

void add_obstacle(Scenario& scenario, std::vector<Vec2> polygon) {
  Obstacle obstacle;
  obstacle.name = "obstacle " + std::to_string(scenario.obstacles.size() + 1);
  obstacle.shape = std::move(polygon);
  scenario.obstacles.push_back(std::move(obstacle));
}

std::vector<Vec2> rectangle(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

/// 0 … count − 1 in random order (Fisher-Yates).
std::vector<int> shuffled(int count, Rng& rng) {
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
  for (int i = count - 1; i > 0; --i) {
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(rng.below(i + 1))]);
  }
  return order;
}

// ---- random
// ----------------------------------------------------------------------------------------------------------

constexpr double kSide = 20.0;      // m, up to kReferenceTeam cars
constexpr int kReferenceTeam = 26;  // beyond it the world grows …
constexpr double kAreaPerCar =
    400.0 / 20.0;  // … to this, m²: 0.05 cars per m², the density of 20 cars in 20 × 20 m
constexpr double kObstaclesPerArea = 20.0 / 400.0;
constexpr double kObstacleGap = 1.2;                // m between circumscribed circles
constexpr double kClear = 0.75;                     // m from a rear axle to obstacles and bounds
constexpr double kShortest = 9.2, kLongest = 11.2;  // m from start to goal
constexpr double kHeadingSpread = 0.8;              // rad off the straight way
constexpr int kTries = 2000;                        // draws of one thing before the whole scene is drawn anew

bool scatter_obstacles(Scenario& scenario, std::vector<Clutter>& clutter, int count, Rng& rng) {
  const double side = scenario.bounds.high.x;
  for (int i = 0; i < count; ++i) {
    int tries = 0;
    for (; tries < kTries; ++tries) {
      const double radius = rng.uniform(0.4, 1.0);
      const Vec2 center{rng.uniform(radius, side - radius), rng.uniform(radius, side - radius)};
      if (!far_from(clutter, center, radius + kObstacleGap)) continue;
      clutter.push_back({center, radius});
      add_obstacle(scenario, inscribed_polygon(clutter.back(), rng));
      break;
    }
    if (tries == kTries) return false;
  }
  return true;
}

bool scatter_robots(Scenario& scenario, const std::vector<Clutter>& clutter, int count, Rng& rng) {
  const double side = scenario.bounds.high.x;
  const geom::Box inside = scenario.bounds.inflated(-kClear);
  const auto apart = [&](Vec2 start, Vec2 goal) {
    return std::all_of(scenario.robots.begin(), scenario.robots.end(), [&](const Robot& other) {
      return geom::norm(other.start.position() - start) >= kApart &&
             geom::norm(other.goal->position() - goal) >= kApart;
    });
  };
  for (int i = 0; i < count; ++i) {
    int tries = 0;
    for (; tries < kTries; ++tries) {
      const Vec2 start{rng.uniform(kClear, side - kClear), rng.uniform(kClear, side - kClear)};
      const double way = rng.uniform(-kPi, kPi);
      const Vec2 goal = start + rng.uniform(kShortest, kLongest) * geom::unit(way);
      const double leave = geom::wrap_angle(way + rng.uniform(-kHeadingSpread, kHeadingSpread));
      const double arrive = geom::wrap_angle(way + rng.uniform(-kHeadingSpread, kHeadingSpread));
      if (!inside.contains(goal) || !far_from(clutter, start, kClear) || !far_from(clutter, goal, kClear))
        continue;
      if (!apart(start, goal)) continue;
      add_robot(scenario, {start.x, start.y, leave}, {goal.x, goal.y, arrive});
      break;
    }
    if (tries == kTries) return false;
  }
  return true;
}

Scenario random_scene(int robots, std::uint64_t seed, std::optional<int> obstacles) {
  double side = robots <= kReferenceTeam ? kSide : std::sqrt(kAreaPerCar * robots);
  const int count = obstacles.value_or(static_cast<int>(std::lround(kObstaclesPerArea * side * side)));
  // More clutter than the default world can hold starts in one that can: 11 m² an obstacle.
  side = std::max(side, std::sqrt(11.0 * count));
  Rng rng(seed);
  // A scene that got stuck is drawn anew in a world 2 % wider: for the default numbers practically never, for
  // any numbers in the end.
  for (;; side *= 1.02) {
    Scenario scenario = blank(Family::random, robots, seed);
    scenario.bounds = {{0.0, 0.0}, {side, side}};
    std::vector<Clutter> clutter;
    if (scatter_obstacles(scenario, clutter, count, rng) && scatter_robots(scenario, clutter, robots, rng)) {
      return scenario;
    }
  }
}

// ---- swap
// ------------------------------------------------------------------------------------------------------------

Scenario swap_scene(int robots, std::uint64_t seed) {
  constexpr double kLeastRadius = 5.0, kRoomAround = 3.0;
  Scenario scenario = blank(Family::swap, robots, seed);
  const double chord = robots > 1 ? kApart / (2.0 * std::sin(kPi / robots)) : 0.0;
  const double radius = std::max(kLeastRadius, chord);
  const double half = radius + kRoomAround;
  scenario.bounds = {{-half, -half}, {half, half}};
  // The seed turns the ring as a whole: the same task in another place of the number grid.
  const double turn = Rng(seed).uniform(0.0, 2.0 * kPi / robots);
  for (int i = 0; i < robots; ++i) {
    const double angle = turn + 2.0 * kPi * i / robots;
    const double way = geom::wrap_angle(angle + kPi);
    const Vec2 start = radius * geom::unit(angle);
    add_robot(scenario, {start.x, start.y, way}, {-start.x, -start.y, way});
  }
  return scenario;
}

// ---- corridor
// --------------------------------------------------------------------------------------------------------

Scenario corridor_scene(int robots, std::uint64_t seed) {
  // Two cars of 0.4 m pass each other in 1.6 m with 0.27 m to spare on every side.
  constexpr double kWidth = 1.6, kLength = 4.0, kPitch = 1.7, kEdge = 1.2;
  Scenario scenario = blank(Family::corridor, robots, seed);
  Rng rng(seed);
  // Each room is a square lattice of places with room for the starts of one half and the goals of the other,
  // a third left empty.
  const int places = std::max(6, (3 * robots + 1) / 2);
  const int rows = static_cast<int>(std::ceil(std::sqrt(places)));
  const int columns = (places + rows - 1) / rows;
  const double half_height = 0.5 * kPitch * (rows - 1) + kEdge;
  const double room = kPitch * (columns - 1) + 2.0 * kEdge;
  scenario.bounds = {{-0.5 * kLength - room, -half_height}, {0.5 * kLength + room, half_height}};
  add_obstacle(scenario, rectangle({-0.5 * kLength, -half_height}, {0.5 * kLength, -0.5 * kWidth}));
  add_obstacle(scenario, rectangle({-0.5 * kLength, 0.5 * kWidth}, {0.5 * kLength, half_height}));

  const std::array order{shuffled(rows * columns, rng), shuffled(rows * columns, rng)};
  std::array<std::size_t, 2> taken{0, 0};
  const auto next_place = [&](std::size_t side, double heading) -> Pose2 {
    const int place = order[side][taken[side]++];
    const int column = place / rows, row = place % rows;
    const double depth = 0.5 * kLength + kEdge + kPitch * column + rng.uniform(-0.1, 0.1);
    const double y = kPitch * row - 0.5 * kPitch * (rows - 1) + rng.uniform(-0.1, 0.1);
    return {side == 0 ? -depth : depth, y, geom::wrap_angle(heading + rng.uniform(-0.3, 0.3))};
  };
  for (int i = 0; i < robots; ++i) {
    const std::size_t from = static_cast<std::size_t>(i % 2);
    const double way = from == 0 ? 0.0 : kPi;
    const Pose2 start = next_place(from, way);
    add_robot(scenario, start, next_place(1 - from, way));
  }
  return scenario;
}

// ---- parking
// ---------------------------------------------------------------------------------------------------------

std::vector<Vec2> parked_car(const vehicle::Model& model, const Pose2& pose) {
  std::vector<Vec2> corners;
  for (const Vec2 corner : model.footprint) corners.push_back(pose * corner);
  return corners;
}

Scenario parking_scene(int robots, std::uint64_t seed) {
  // Slots 0.35 m wider and 0.2 m deeper than the car open upwards to an aisle; above it lies a row of places
  // along the road.
  constexpr double kSlotWidth = 0.75, kSlotDepth = 0.8, kAisle = 1.8, kRoad = 2.0, kPlace = 1.4;
  Scenario scenario = blank(Family::parking, robots, seed);
  const vehicle::Model& car = scenario.models.front();
  Rng rng(seed);
  const int slots = 2 * robots + 2;
  scenario.bounds = {{-1.5, 0.0}, {kSlotWidth * slots + 1.5, kSlotDepth + kAisle + kRoad}};
  const double middle =
      0.5 * car.length() + geom::bounding_box(car.footprint).low.x;  // of the footprint, ahead of the axle
  const auto in_slot = [&](int slot, bool nose_in) -> Pose2 {
    const double x = kSlotWidth * (slot + 0.5), y = 0.5 * kSlotDepth;
    return nose_in ? Pose2{x, y + middle, -0.5 * kPi} : Pose2{x, y - middle, 0.5 * kPi};
  };
  const auto on_road = [&](int place) -> Pose2 {
    return {kPlace * (place + 0.5), kSlotDepth + kAisle + 0.5 * kRoad + rng.uniform(-0.1, 0.1),
            rng.uniform(-0.1, 0.1)};
  };
  const std::vector<int> slot = shuffled(slots, rng), place = shuffled(robots, rng);
  for (int i = 0; i < robots; ++i) {
    const int at = slot[static_cast<std::size_t>(i)];
    const Pose2 street = on_road(place[static_cast<std::size_t>(i)]);
    // Out of a slot one must back, and the road is driven forwards; into a slot one backs, nose to the aisle:
    // a gear change either way.
    if (i % 2 == 0) {
      add_robot(scenario, in_slot(at, true), street);
    } else {
      add_robot(scenario, street, in_slot(at, false));
    }
  }
  for (std::size_t i = static_cast<std::size_t>(robots); i < slot.size(); ++i) {
    Pose2 pose = in_slot(slot[i], rng.below(2) == 0);
    pose.x += rng.uniform(-0.04, 0.04);
    pose.heading += rng.uniform(-0.04, 0.04);
    add_obstacle(scenario, parked_car(car, pose));
  }
  return scenario;
}

}  // namespace

const char* name_of(Family family) {
  switch (family) {
    case Family::random:
      return "random";
    case Family::swap:
      return "swap";
    case Family::corridor:
      return "corridor";
    case Family::parking:
      return "parking";
  }
  return "?";
}

std::optional<Family> family_named(std::string_view name) {
  for (const Family family : kFamilies) {
    if (name == name_of(family)) return family;
  }
  return std::nullopt;
}

std::span<const Family> all_families() {
  return kFamilies;
}

vehicle::Model standard_car() {
  vehicle::Model car;
  car.footprint = vehicle::rectangle_footprint(0.60, 0.40, 0.10);
  car.limits.lateral_acceleration = 3.0;
  return car;
}

Scenario generate(Family family, int robots, std::uint64_t seed, const FamilyOptions& options) {
  if (robots < 1 || robots > kMostRobots) {
    throw InputError("a team has 1 to " + std::to_string(kMostRobots) + " robots, not " +
                     std::to_string(robots));
  }
  if (options.obstacles && family != Family::random) {
    throw InputError(std::string("the number of obstacles is only for the family random, not ") +
                     name_of(family));
  }
  if (options.obstacles && (*options.obstacles < 0 || *options.obstacles > kMostRobots)) {
    throw InputError("the number of obstacles is 0 to " + std::to_string(kMostRobots) + ", not " +
                     std::to_string(*options.obstacles));
  }
  switch (family) {
    case Family::random:
      return random_scene(robots, seed, options.obstacles);
    case Family::swap:
      return swap_scene(robots, seed);
    case Family::corridor:
      return corridor_scene(robots, seed);
    case Family::parking:
      return parking_scene(robots, seed);
  }
  throw InputError("no such family");
}

}  // namespace seine::world
