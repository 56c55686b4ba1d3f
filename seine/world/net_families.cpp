#include "seine/world/net_families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/world/check.hpp"
#include "seine/world/check_parts.hpp"
#include "seine/world/clutter.hpp"
#include "seine/world/families.hpp"
#include "seine/world/passage.hpp"

namespace seine::world {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr double kPi = std::numbers::pi;
constexpr double kRim = 1.0;                                // m
constexpr double kMast = 0.2;                               // m ahead of the rear axle
constexpr double kAtRest = 0.86;                            // opening at the start
constexpr double kDeliveryRadius = 0.5;                     // m
constexpr std::array kSides{2.2, 2.0, 1.7, 1.4, 1.3, 1.2};  // m, for 3 … 8 cars
// Half the width, m, of the passage that is kept free of tall obstacles. A squeezed net of 3, 4 and 6 cars
// was measured to need gaps of 2.0, 2.0 and 2.45 m: 0.2 m is to spare on either side.
constexpr std::array kPassages{1.2, 1.2, 1.3, 1.45, 1.5, 1.5};

void expect_team(int robots) {
  if (robots >= kLeastNetTeam && robots <= kMostNetTeam) return;
  throw InputError("a team with a net has " + std::to_string(kLeastNetTeam) + " to " +
                   std::to_string(kMostNetTeam) + " robots in these families, not " + std::to_string(robots));
}

std::size_t index_of(int robots) {
  return static_cast<std::size_t>(robots - kLeastNetTeam);
}

Scenario blank(const char* family, int robots, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = std::string(family) + "-" + std::to_string(robots) + "-" + std::to_string(seed);
  scenario.models = {standard_car()};
  scenario.net = family_net(robots);
  return scenario;
}

/// The net around the origin, turned by `turn` and open to `opening`.
std::vector<Vec2> held_net(const net::Net& net, double opening, double turn) {
  const Pose2 frame{0.0, 0.0, turn};
  std::vector<Vec2> corners;
  for (const Vec2 corner : net.rest) corners.push_back(opening * (frame * corner));
  return corners;
}

/// All cars face along `frame`; the middle of the net lies in its origin.
void add_team(Scenario& scenario, const Pose2& frame, double turn) {
  for (const Vec2 corner : held_net(*scenario.net, kAtRest, turn)) {
    const Vec2 rear = frame * (corner - Vec2{kMast, 0.0});
    scenario.robots.push_back({.name = "car" + std::to_string(scenario.robots.size()),
                               .start = {rear.x, rear.y, geom::wrap_angle(frame.heading)},
                               .goal = std::nullopt});
  }
}

void add_obstacle(Scenario& scenario, std::vector<Vec2> polygon, double height) {
  Obstacle obstacle;
  obstacle.name = "obstacle " + std::to_string(scenario.obstacles.size() + 1);
  obstacle.shape = std::move(polygon);
  obstacle.height = height;
  scenario.obstacles.push_back(std::move(obstacle));
}

// ---- throw

constexpr double kAhead = 0.8;                     // rad
constexpr double kNearest = 1.0, kFarthest = 5.0;  // m to the catch
constexpr double kSlowest = 3.5, kFastest = 10.5;  // m/s at the rim
constexpr double kSteepest = 42.0 * kPi / 180.0;   // rad from vertical
constexpr double kLongestFlight = 1.8;             // s
constexpr double kLowestRelease = 1.2;  // m: above the rim, so that it meets the net from above only
constexpr double kTurnPrice = 0.5, kFreeTurn = 0.3;  // s per rad that the team must turn, beyond so many rad
constexpr double kCatchRoom = 1.6,
                 kEndRoom = 1.8;                   // m from obstacles to the catch, and to start and delivery
constexpr double kObstacleGap = 0.5;               // m between circumscribed circles
constexpr double kEase = 0.02;                     // m, and as a share: how far a catch stays off its limits
constexpr double kClutterRoom = 2.0, kRoom = 4.0;  // m around the way: for obstacles, and for the bounds
constexpr int kTries = 200;                        // draws of one obstacle, and of a whole clutter

/// Where, when and how the object falls through the rim; in the team's frame (x along the headings).
struct Throw {
  Vec2 at;
  double bearing, distance;  // of `at` from the middle of the net
  geom::Vec3 velocity;       // at the rim
  double mass;
  double time, flight;  // s: of the catch on the common clock, since the release
};

/// Time in which a team at rest covers `distance` and then drives at `speed` (m/s) or less.
double arrival_time(double distance, double speed) {
  const vehicle::Limits limits = standard_car().limits;
  const double a = limits.acceleration;
  const double end = std::min(speed, std::sqrt(2.0 * a * distance));
  const double top = std::min(limits.speed, std::sqrt(a * distance + 0.5 * end * end));
  const double covered = (top * top - 0.5 * end * end) / a;
  return (2.0 * top - end) / a + (distance - covered) / top;
}

/// Whether the net, somewhere between 88 and 94 % open and at the best place, may catch the object while it
/// moves at `drive` (m/s).
bool catchable(const net::Net& net, double turn, const Throw& thrown, Vec2 drive) {
  net::Target target;
  target.position = {0.0, 0.0, net.rim()};
  target.velocity = thrown.velocity;
  target.mass = thrown.mass;
  const auto crossing = net::Flight(target).crossing(net.rim());
  for (int percent = 88; percent <= 94; percent += 2) {
    std::vector<Vec2> corners = held_net(net, 0.01 * percent + 1e-9, turn);
    const net::Catch centred = net::measure_catch(net, target, *crossing, corners, {drive, {}});
    // The middle of the net between the two points that need room, a little nearer to where less is needed.
    const Vec2 sideways = thrown.velocity.ground() - drive;
    const double shift = centred.depth * geom::norm(sideways) / -thrown.velocity.z;
    const double ahead = std::max(0.0, 0.5 * (shift - (net::kRimMargin - net::kContactMargin)));
    const Vec2 offset = shift > 1e-9 ? (ahead / geom::norm(sideways)) * sideways : Vec2{};
    for (Vec2& corner : corners) corner += offset;
    const net::Catch c = net::measure_catch(net, target, *crossing, corners, {drive, {}});
    const double limit = net::speed_limit(c.depth, target.radius, net.rebound);
    if (c.rim_margin >= net::kRimMargin + kEase && c.contact_margin >= net::kContactMargin + kEase &&
        c.angle <= (1.0 - kEase) * net::kMaxAngle && c.speed <= (1.0 - kEase) * limit &&
        c.bottom >= net.clearance + kEase) {
      return true;
    }
  }
  return false;
}

/// The fastest way to drive towards the catch at which it may succeed, m/s.
std::optional<double> fastest_catch(const net::Net& net, double turn, const Throw& thrown) {
  for (double speed = standard_car().limits.speed; speed > -0.01; speed -= 0.25) {
    if (catchable(net, turn, thrown, std::max(0.0, speed) * geom::unit(thrown.bearing)))
      return std::max(0.0, speed);
  }
  return std::nullopt;
}

/// How far the team must turn before it drives along `bearing`, forwards or backwards, rad.
double turn_towards(double bearing) {
  const double off = std::abs(geom::wrap_angle(bearing));
  return std::min(off, kPi - off);
}

/// How long the object may have been in the air, s: [least, most]; empty when least > most. It was released
/// above kLowestRelease, that is between the roots of 1 + v t − g t²/2 = kLowestRelease.
std::pair<double, double> flight_range(double falling, double most) {
  const double square = falling * falling - 2.0 * net::kGravity * (kLowestRelease - kRim);
  if (square < 0.0) return {1.0, 0.0};
  const double root = std::sqrt(square);
  return {std::max(0.1, (falling - root) / net::kGravity),
          std::min({most, kLongestFlight, (falling + root) / net::kGravity})};
}

std::optional<Throw> draw_throw(const net::Net& net, double turn, Rng& rng) {
  Throw thrown{};
  thrown.bearing = rng.below(3) < 2 ? rng.uniform(-kAhead, kAhead) : rng.uniform(-kPi, kPi);
  thrown.distance = rng.uniform(kNearest, kFarthest);
  thrown.at = thrown.distance * geom::unit(thrown.bearing);
  const double speed = rng.uniform(kSlowest, kFastest), angle = rng.uniform(0.0, kSteepest);
  const Vec2 sideways = speed * std::sin(angle) * geom::unit(rng.uniform(-kPi, kPi));
  thrown.velocity = {sideways.x, sideways.y, -speed * std::cos(angle)};
  thrown.mass = rng.uniform(0.1, 0.4);
  const double slack = rng.uniform(1.15, 1.9);
  const double part = rng.uniform();
  const std::optional<double> drive = fastest_catch(net, turn, thrown);
  if (!drive) return std::nullopt;
  const double dash = arrival_time(thrown.distance, standard_car().limits.speed);
  const double needed = arrival_time(thrown.distance, *drive);
  const double turning = kTurnPrice * std::max(0.0, turn_towards(thrown.bearing) - kFreeTurn);
  thrown.time = std::max(slack * dash, 1.15 * needed) + turning;
  const auto [least, most] = flight_range(-thrown.velocity.z, thrown.time);
  if (least > most) return std::nullopt;
  thrown.flight = least + part * (most - least);
  return thrown;
}

/// The state at its release, of an object that flies as `thrown` says.
net::Target released(const Throw& thrown, const Pose2& frame) {
  const Pose2 turned{0.0, 0.0, frame.heading};
  const Vec2 at = frame * thrown.at;
  const Vec2 drift = turned * thrown.velocity.ground();
  const double s = thrown.flight;
  net::Target target;
  target.time = thrown.time - s;
  target.velocity = {drift.x, drift.y, thrown.velocity.z + net::kGravity * s};
  target.position = {at.x - s * drift.x, at.y - s * drift.y,
                     kRim - s * thrown.velocity.z - 0.5 * net::kGravity * s * s};
  target.mass = thrown.mass;
  return target;
}

/// The places that matter, in the world.
struct Way {
  Vec2 start, at, delivery;

  geom::Box box() const {
    geom::Box box;
    for (const Vec2 place : {start, at, delivery}) box.include(place);
    return box;
  }
};

struct LowOrTall {
  Clutter clutter;
  double height;
};

std::optional<LowOrTall> draw_obstacle(const Way& way, const std::vector<LowOrTall>& others, Rng& rng) {
  const geom::Box box = way.box().inflated(kClutterRoom);
  for (int i = 0; i < kTries; ++i) {
    const Clutter drawn{{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)},
                        rng.uniform(0.2, 0.6)};
    const double height = rng.below(3) == 0 ? rng.uniform(0.1, 0.2) : std::numeric_limits<double>::infinity();
    const auto away = [&](Vec2 place, double room) {
      return geom::norm(place - drawn.center) >= room + drawn.radius;
    };
    const bool free = away(way.start, kEndRoom) && away(way.delivery, kEndRoom) && away(way.at, kCatchRoom) &&
                      std::all_of(others.begin(), others.end(), [&](const LowOrTall& o) {
                        return away(o.clutter.center, o.clutter.radius + kObstacleGap);
                      });
    if (free) return LowOrTall{drawn, height};
  }
  return std::nullopt;
}

/// Obstacles that leave a passage from the start by way of the catch to the delivery; none when no draw did.
std::optional<std::vector<LowOrTall>> draw_clutter(const Way& way, int count, double half_width, Rng& rng) {
  for (int round = 0; round < kTries; ++round) {
    std::vector<LowOrTall> drawn;
    while (static_cast<int>(drawn.size()) < count) {
      const auto next = draw_obstacle(way, drawn, rng);
      if (!next) break;
      drawn.push_back(*next);
    }
    if (static_cast<int>(drawn.size()) < count) continue;
    std::vector<Clutter> tall;
    for (const LowOrTall& o : drawn)
      if (o.height >= kRim) tall.push_back(o.clutter);
    const auto open = [&](Vec2 from, Vec2 to) {
      return passage(tall, way.box().inflated(kRoom), from, to, half_width);
    };
    if (open(way.start, way.at) && open(way.at, way.delivery)) return drawn;
  }
  return std::nullopt;
}

// None when the draw is no fair task.
std::optional<Scenario> draw_throw_scene(Scenario scenario, int count, Rng& rng) {
  const auto robots = static_cast<int>(scenario.net->size());
  const Pose2 frame{0.0, 0.0, rng.uniform(-kPi, kPi)};
  const double turn = rng.uniform(0.0, 2.0 * kPi);
  const std::optional<Throw> thrown = draw_throw(*scenario.net, turn, rng);
  if (!thrown) return std::nullopt;
  const double onwards = thrown->bearing + rng.uniform(-0.6, 0.6);
  const Vec2 delivery = thrown->at + rng.uniform(5.0, 9.0) * geom::unit(onwards);
  const Way way{{}, frame * thrown->at, frame * delivery};
  const auto clutter = draw_clutter(way, count, kPassages[index_of(robots)], rng);
  if (!clutter) return std::nullopt;
  add_team(scenario, frame, turn);
  for (const LowOrTall& o : *clutter) add_obstacle(scenario, inscribed_polygon(o.clutter, rng), o.height);
  scenario.targets.push_back(released(*thrown, frame));
  scenario.delivery = net::Delivery{way.delivery, kDeliveryRadius, std::nullopt};
  scenario.bounds = way.box().inflated(kRoom);
  if (!check(scenario, StaticMap(scenario)).empty()) return std::nullopt;
  return scenario;
}

}  // namespace

net::Net family_net(int robots) {
  expect_team(robots);
  const double radius = 0.5 * kSides[index_of(robots)] / std::sin(kPi / robots);
  net::Net net;
  for (int k = 0; k < robots; ++k) net.rest.push_back(radius * geom::unit(2.0 * kPi * k / robots));
  net.attachments.assign(net.rest.size(), {{kMast, 0.0}, kRim});
  return net;
}

Scenario throw_scene(int robots, std::uint64_t seed, Clutteredness clutteredness) {
  expect_team(robots);
  Rng rng(seed);
  const bool dense = clutteredness == Clutteredness::dense;
  const Scenario empty = blank(dense ? "throw-dense" : "throw", robots, seed);
  // What is no fair task is drawn anew.
  for (;;) {
    const int count = dense ? 10 + rng.below(13) : rng.below(9);
    if (auto scenario = draw_throw_scene(empty, count, rng)) return *std::move(scenario);
  }
}

Scenario gap_scene(int robots, std::uint64_t seed, double width) {
  expect_team(robots);
  if (!(width >= kNarrowestGap && width <= kWidestGap)) {
    throw InputError("a gap is " + number(kNarrowestGap) + " to " + number(kWidestGap) + " m wide, not " +
                     number(width));
  }
  Rng rng(seed);
  constexpr double kHalf = 6.0;  // m, of the world across the carry
  Scenario scenario = blank("gap", robots, seed);
  const double wall = rng.uniform(3.5, 5.0), thick = rng.uniform(0.2, 0.5), middle = rng.uniform(-1.5, 1.5);
  const double beyond = rng.uniform(4.0, 6.0);
  scenario.bounds = {{-4.0, -kHalf}, {wall + thick + beyond + 4.0, kHalf}};
  for (const auto& [low, high] :
       {std::pair{-kHalf, middle - 0.5 * width}, std::pair{middle + 0.5 * width, kHalf}}) {
    if (low >= high) continue;
    add_obstacle(scenario, {{wall, low}, {wall + thick, low}, {wall + thick, high}, {wall, high}},
                 std::numeric_limits<double>::infinity());
  }
  add_team(scenario, {0.0, rng.uniform(-1.0, 1.0), rng.uniform(-0.4, 0.4)}, rng.uniform(0.0, 2.0 * kPi));
  scenario.payload = net::Payload{};
  scenario.delivery =
      net::Delivery{{wall + thick + beyond, middle + rng.uniform(-1.5, 1.5)}, kDeliveryRadius, std::nullopt};
  return scenario;
}

}  // namespace seine::world
