#include "seine/search/making_way.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "seine/geom/convex.hpp"
#include "seine/search/bays.hpp"

namespace seine::search {
namespace {

constexpr int kBriefly = 4000;       // expansions of one search for a way
constexpr std::size_t kRefuges = 3;  // for one car and those it makes way for
// As in the path search (docs/front-end-paths.md), in car lengths and widths.
constexpr double kSlack = 0.025, kEaseRadius = 1.5, kDiscCell = 0.2;
constexpr double kRoom = 0.03;  // car lengths, on top of the clearance to the others' ways

constexpr double kReverse = 1.3;          // what a metre backwards costs
constexpr double kSteeringChange = 0.05;  // turning radii, from straight to the tightest turn

/// One search for refuges, lengths in turning radii.
struct Rung {
  double radius;   // of the smallest turning radius …
  double lengths;  // … and at least so many car lengths
  double step, cell;
  int headings;
  double slack;  // of the full slack
  int expansions;
};
// A car that turns on the spot, nearly, would be turned far too much by each move between two walls.
constexpr Rung kRungs[] = {{1.1, 0.0, 0.8, 0.45, 24, 1.0, 2000},
                           {1.1, 1.0, 0.3, 0.2, 36, 0.5, 3000},
                           {1.02, 0.0, 0.4, 0.2, 36, 0.2, 8000},
                           {1.02, 2.0, 0.1, 0.06, 72, 0.2, 8000}};

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

MakingWay::MakingWay(const world::Scenario& scenario, const world::StaticMap& map,
                     std::span<const PathPlanner> planners, const Settings& settings)
    : scenario_(scenario),
      map_(map),
      planners_(planners),
      settings_(settings),
      distances_(scenario.models.size()) {}

std::optional<Path> MakingWay::plan(int robot, const geom::Pose2& from, const geom::Pose2& to,
                                    const Footprints& parked) const {
  return planners_[idx(scenario_.robots[idx(robot)].model)].plan(
      from, to,
      {.max_expansions = kBriefly,
       .clearance = scenario_.margins.obstacle,
       .parked = parked,
       .parked_clearance = settings_.robot_clearance,
       .quickest = parked.empty(),
       .deadline = settings_.deadline});
}

std::vector<Path> MakingWay::by_bays(int robot, const Path& way, const Other& other) const {
  const world::Robot& who = scenario_.robots[idx(robot)];
  std::vector<Path> ways;
  for (const geom::Pose2& bay : bays_beside(
           {&map_, &scenario_.model_of(who), &way, &scenario_.model_of(scenario_.robots[idx(other.robot)]),
            &other.way, scenario_.margins.obstacle, scenario_.margins.robot})) {
    std::optional<Path> path = plan(robot, who.start, bay, {});
    const std::optional<Path> rest = path ? plan(robot, bay, *who.goal, {}) : std::nullopt;
    if (!rest) continue;
    append(*path, *rest, true);
    ways.push_back(*std::move(path));
  }
  return ways;
}

MakingWay::Footprints MakingWay::standing(std::span<const Other> others, bool at_goals) const {
  Footprints footprints;
  for (const Other& other : others) {
    const world::Robot& who = scenario_.robots[idx(other.robot)];
    const geom::Convex body{scenario_.model_of(who).footprint};
    footprints.push_back(geom::placed(body, at_goals ? *who.goal : who.start).core);
  }
  return footprints;
}

// While the others stand at their starts.
std::vector<Route> MakingWay::routes_to_refuges(int robot, const Lane& lane, const Footprints& parked) {
  const world::Robot& who = scenario_.robots[idx(robot)];
  const vehicle::Model& model = scenario_.model_of(who);
  auto& distances = distances_[idx(who.model)];
  if (!distances)
    distances = std::make_unique<PointDistances>(map_, kDiscCell * model.width(), 1.5 * model.length());
  FootprintChecker free(map_, distances.get(), model, scenario_.margins.obstacle);
  for (const auto& footprint : parked) free.park(footprint, settings_.robot_clearance);
  const double room = free.exact_room(who.start);
  for (const Rung& rung : kRungs) {
    FootprintChecker checker = free;
    const double slack = rung.slack * kSlack * model.length(), tightest = 1.0 / model.max_curvature(),
                 radius = std::max(rung.radius * tightest, rung.lengths * model.length());
    // For a car that turns wide anyway the gentle searches are the others over again.
    if (rung.lengths > 0.0 && radius < 1.5 * tightest) continue;
    checker.set_slack(slack);
    checker.ease_slack(who.start.position(), kEaseRadius * model.length(),
                       std::clamp(0.5 * room, 0.0, slack));
    std::vector<Route> found = refuges(who.start, checker, lane,
                                       {.radius = radius,
                                        .step = rung.step * radius,
                                        .cell = rung.cell * radius,
                                        .headings = rung.headings,
                                        .reverse = model.limits.reverse_speed > 0.0,
                                        .room = kRoom * model.length(),
                                        .max_expansions = rung.expansions,
                                        .deadline = settings_.deadline},
                                       kRefuges);
    RouteCosts costs;
    costs.radius = radius;
    costs.driving.reverse =
        model.limits.reverse_speed > 0.0 ? kReverse : std::numeric_limits<double>::infinity();
    costs.driving.gear_change = radius;
    costs.steering_change = kSteeringChange * radius;
    for (Route& route : found) shorten(route, checker, costs);
    if (!found.empty()) return found;
  }
  return {};
}

std::vector<Path> MakingWay::by_refuges(int robot, const Path& way, std::span<const Other> others) {
  const world::Robot& who = scenario_.robots[idx(robot)];
  const vehicle::Model& model = scenario_.model_of(who);
  Lane lane;
  for (const Other& other : others)
    lane.add(scenario_.model_of(scenario_.robots[idx(other.robot)]), other.way, settings_.robot_clearance);
  const Footprints before = standing(others, false), after = standing(others, true);
  std::vector<Path> ways;
  for (const Route& route : routes_to_refuges(robot, lane, before)) {
    if (route.arcs.empty()) continue;  // it is in nobody's way where it starts
    Path path = sampled(route, kPathSpacing * model.length());
    if (std::optional<Path> rest = plan(robot, route.goal, *who.goal, after)) {
      append(path, *rest, true);
    } else if (model.limits.reverse_speed > 0.0) {
      // As it came, and then its own way.
      append(path, sampled(reversed(route), kPathSpacing * model.length()), true);
      append(path, way, true);
    } else {
      continue;
    }
    ways.push_back(std::move(path));
  }
  return ways;
}

}  // namespace seine::search
