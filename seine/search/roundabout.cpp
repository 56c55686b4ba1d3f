#include "seine/search/roundabout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/search/path_planner.hpp"
#include "seine/search/route.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

// Fewer robots than this pass a crossing quicker by giving way.
constexpr std::size_t kFewest = 4;
// Robots whose straight way passes the middle at this distance or less, in car lengths, belong to the
// crossing.
constexpr double kThrough = 2.0;
// Room for one car on the ring, in car lengths.
constexpr double kSpacing = 1.5;
// Turns at the start and the goal, in smallest turning radii: at a gentle one the car need not slow down so
// much.
constexpr double kGentle = 2.2, kTight = 1.1;
constexpr double kTurn = 2.0 * std::numbers::pi;

double longest_car(const world::Scenario& scenario) {
  double length = 0.0;
  for (const world::Robot& robot : scenario.robots)
    length = std::max(length, scenario.model_of(robot).length());
  return length;
}

std::optional<Vec2> crossing_point(const world::Robot& a, const world::Robot& b) {
  const Vec2 p = a.start.position(), q = b.start.position();
  const Vec2 u = a.goal->position() - p, v = b.goal->position() - q;
  const double det = cross(u, v);
  // Ways that meet head on meet half way, whatever their rounding says.
  if (!(std::abs(det) > 1e-3 * norm(u) * norm(v))) {
    if (dot(u, v) >= 0.0) return std::nullopt;  // also where one of them stands
    return 0.5 * (p + q);
  }
  const double s = cross(q - p, v) / det, t = cross(q - p, u) / det;
  if (s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0) return std::nullopt;
  return p + s * u;
}

double distance_to_way(const world::Robot& robot, Vec2 point) {
  const Vec2 p = robot.start.position(), u = robot.goal->position() - p;
  const double length2 = std::max(squared_norm(u), 1e-12);
  const double s = std::clamp(dot(point - p, u) / length2, 0.0, 1.0);
  return norm(p + s * u - point);
}

// A car that stands or only shifts a little has no use for a ring.
bool passes(const world::Scenario& scenario, const world::Robot& robot) {
  return norm(robot.goal->position() - robot.start.position()) > scenario.model_of(robot).length();
}

double turn_left(double from, double to) {
  const double turn = std::fmod(to - from, kTurn);
  return turn < 0.0 ? turn + kTurn : turn;
}

// The heading of the line that has one circle's centre `from_left` m on its left and then another's
// `to_left`; nothing when they are too close.
std::optional<double> tangent(Vec2 from, double from_left, Vec2 to, double to_left) {
  const Vec2 d = to - from;
  const double across = to_left - from_left, along2 = squared_norm(d) - across * across;
  if (along2 <= 0.0) return std::nullopt;
  return std::atan2(d.y, d.x) - std::atan2(across, std::sqrt(along2));
}

struct Ring {
  Vec2 center;
  double radius;
};

// Turn, straight, round the ring, straight, turn: a Dubins path whose middle turn is the ring. `first` and
// `last` are the signed radii of the turns at the ends, positive to the left.
std::optional<std::vector<vehicle::Arc>> arcs_by_ring(const geom::Pose2& start, const geom::Pose2& goal,
                                                      const Ring& ring, double first, double last) {
  const Vec2 a = start * Vec2{0.0, first}, b = goal * Vec2{0.0, last};
  const auto in = tangent(a, first, ring.center, ring.radius),
             out = tangent(ring.center, ring.radius, b, last);
  if (!in || !out) return std::nullopt;
  const double round = turn_left(*in, *out);
  constexpr double kLongest = 0.7;  // of a whole turn: beyond, its way does not lead through
  const double turn_in = first > 0.0 ? turn_left(start.heading, *in) : turn_left(*in, start.heading);
  const double turn_out = last > 0.0 ? turn_left(*out, goal.heading) : turn_left(goal.heading, *out);
  if (round > kLongest * kTurn || turn_in > 0.5 * kTurn || turn_out > 0.5 * kTurn) return std::nullopt;
  const auto straight = [](Vec2 from, double from_left, Vec2 to, double to_left) {
    const double across = to_left - from_left;
    return std::sqrt(squared_norm(to - from) - across * across);
  };
  return std::vector<vehicle::Arc>{{1.0 / first, std::abs(first) * turn_in},
                                   {0.0, straight(a, first, ring.center, ring.radius)},
                                   {1.0 / ring.radius, ring.radius * round},
                                   {0.0, straight(ring.center, ring.radius, b, last)},
                                   {1.0 / last, std::abs(last) * turn_out}};
}

double length_of(std::span<const vehicle::Arc> arcs) {
  double length = 0.0;
  for (const vehicle::Arc& arc : arcs) length += std::abs(arc.distance);
  return length;
}

}  // namespace

std::optional<Crossing> find_crossing(const world::Scenario& scenario) {
  const std::size_t count = scenario.robots.size();
  if (count < kFewest) return std::nullopt;
  std::vector<double> xs, ys;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto point = crossing_point(scenario.robots[i], scenario.robots[j])) {
        xs.push_back(point->x);
        ys.push_back(point->y);
      }
  if (xs.size() < kFewest * (kFewest - 1) / 2) return std::nullopt;
  const auto middle = static_cast<std::ptrdiff_t>(xs.size() / 2);
  std::nth_element(xs.begin(), xs.begin() + middle, xs.end());
  std::nth_element(ys.begin(), ys.begin() + middle, ys.end());
  Crossing crossing{{xs[xs.size() / 2], ys[ys.size() / 2]}, {}};
  const double through = kThrough * longest_car(scenario);
  for (std::size_t i = 0; i < count; ++i)
    if (passes(scenario, scenario.robots[i]) &&
        distance_to_way(scenario.robots[i], crossing.center) <= through)
      crossing.robots.push_back(static_cast<int>(i));
  // A crossing where only a minority meets is better left to giving way and side steps.
  if (crossing.robots.size() < kFewest || 2 * crossing.robots.size() < count) return std::nullopt;
  return crossing;
}

double ring_radius(const world::Scenario& scenario, const Crossing& crossing) {
  double tightest = 0.0;
  for (const int robot : crossing.robots)
    tightest = std::max(
        tightest, 1.0 / scenario.model_of(scenario.robots[static_cast<std::size_t>(robot)]).max_curvature());
  const double length = longest_car(scenario) + scenario.margins.robot;
  return std::max(1.5 * tightest, kSpacing * length * static_cast<double>(crossing.robots.size()) / kTurn);
}

std::optional<Path> path_by_ring(const world::Scenario& scenario, const world::StaticMap& map, int robot,
                                 Vec2 center, double radius) {
  const world::Robot& who = scenario.robots[static_cast<std::size_t>(robot)];
  const vehicle::Model& model = scenario.model_of(who);
  const FootprintChecker checker(map, nullptr, model, scenario.margins.obstacle);
  std::optional<Route> best;
  for (const double turn : {kGentle / model.max_curvature(), kTight / model.max_curvature()}) {
    for (const double first : {-turn, turn})
      for (const double last : {-turn, turn}) {
        auto arcs = arcs_by_ring(who.start, *who.goal, {center, radius}, first, last);
        if (!arcs || (best && length_of(*arcs) >= length_of(best->arcs))) continue;
        if (sweep(checker, who.start, checker.room(who.start), *arcs) < 0.0) continue;
        best = Route{who.start, *who.goal, std::move(*arcs)};
      }
    if (best) return sampled(*best, kPathSpacing * model.length());
  }
  return std::nullopt;
}

}  // namespace seine::search
