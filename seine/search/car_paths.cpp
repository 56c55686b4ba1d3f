#include "seine/search/car_paths.hpp"

#include "seine/search/drive_time.hpp"
#include "seine/search/leaving.hpp"
#include "seine/search/rolling_start.hpp"
#include "seine/search/whims.hpp"

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

std::vector<PathPlanner> planners_for(const world::Scenario& scenario, const world::StaticMap& map) {
  std::vector<PathPlanner> planners;
  for (const vehicle::Model& model : scenario.models) planners.emplace_back(map, model);
  return planners;
}

}  // namespace

CarPaths::CarPaths(const world::Scenario& scenario, const world::StaticMap& map, const GuessOptions& options)
    : scenario_(scenario),
      map_(map),
      options_(options),
      planners_(planners_for(scenario, map)),
      among_(scenario.models.size()) {}

std::optional<Path> CarPaths::around(int robot, std::span<const Bump> bumps,
                                     std::span<const std::vector<geom::Vec2>> parked, int expansions) const {
  const world::Robot& who = scenario_.robots[idx(robot)];
  const PathOptions options{
      .max_expansions = expansions,
      .clearance = scenario_.margins.obstacle,
      .bumps = bumps,
      .parked = parked,
      .parked_clearance = scenario_.margins.robot + options_.extra_robot_clearance,
      .quickest = options_.quickest && bumps.empty() && parked.empty() &&
                  (scenario_.robots.size() == 1 || slow_reverse(scenario_.model_of(who).limits)),
      .deadline = options_.deadline};
  return starts_inside_margin(scenario_, map_, who) ? out_of_margin(who, options)
                                                    : from(who, who.start, options);
}

// Out of the margin first, then as usual; the shortest of the ways that are found.
std::optional<Path> CarPaths::out_of_margin(const world::Robot& who, const PathOptions& options) const {
  std::optional<Path> best;
  for (Path& out : ways_out(scenario_, map_, who)) {
    const int gear = out.points.front().gear;
    if (gear * who.start_speed < 0.0 || (best && out.length() >= best->length())) continue;
    const std::optional<Path> rest =
        planners_[idx(who.model)].plan(out.points.back().pose, *who.goal, options);
    if (!rest) continue;
    append(out, *rest);
    if (!best || out.length() < best->length()) best = std::move(out);
  }
  return best;
}

std::optional<Path> CarPaths::among(int robot, std::span<const Traffic> traffic,
                                    const TeamSearch::Sources::Among& how) {
  const world::Robot& who = scenario_.robots[idx(robot)];
  if (who.start_speed != 0.0) return std::nullopt;
  std::unique_ptr<SpaceTimePlanner>& planner = among_[idx(who.model)];
  const vehicle::Model& model = scenario_.model_of(who);
  if (!planner)
    planner = std::make_unique<SpaceTimePlanner>(map_, model, speed_grid(model, options_.lattice));
  constexpr double kExtra = 0.05;  // car lengths: for the velocity plan's steps and for the optimiser
  return planner->plan(who.start, *who.goal, traffic,
                       {.clearance = scenario_.margins.obstacle,
                        .extra = kExtra * model.length(),
                        .pace = how.pace,
                        .patience = how.patience,
                        .hurry = how.hurry,
                        .deadline = options_.deadline});
}

// A car that is moving follows a path from its speed on where it can; elsewhere it first brakes straight on,
// as gently as there is room for.
std::optional<Path> CarPaths::from(const world::Robot& who, const geom::Pose2& start,
                                   const PathOptions& options) const {
  if (who.rests_at_goal()) return Path{{{0.0, start, 0.0, 1}}};
  const PathPlanner& planner = planners_[idx(who.model)];
  if (who.start_speed == 0.0) return planner.plan(start, *who.goal, options);

  PathOptions plainly = options;
  plainly.short_moves = false;
  plainly.quickest = false;  // what is quickest from rest need not be from speed
  const vehicle::Model& model = scenario_.model_of(who);
  const RollingStart rolling{
      &map_, &model, start, who.start_speed, options.clearance, speed_grid(model, options_.lattice).step};
  const double hardest = options_.lattice.acceleration_factor;
  std::optional<Path> path = planner.plan(start, *who.goal, plainly);
  // Where that failed the car brakes first.
  if (path && options_.quickest && follows(rolling, *path, hardest)) return path;
  const std::optional<Path> ways_to_brake[] = {brake_straight(rolling, 0.7 * hardest),
                                               brake_straight(rolling, hardest),
                                               brake_before_obstacle(rolling, hardest)};
  for (std::optional<Path> braking : ways_to_brake) {
    if (!braking) continue;
    const std::optional<Path> onwards = planner.plan(braking->points.back().pose, *who.goal, options);
    if (!onwards) continue;
    append(*braking, *onwards);
    return braking;
  }
  return path && path->length() > 0.0 && path->points.front().gear == rolling.gear() ? path : std::nullopt;
}

// A car by itself has no order to change: another seed makes it try another way; and where its way changes
// gear, the quickest of a few is taken.
std::optional<Path> CarPaths::first(int robot) const {
  constexpr int kPatience = 20000, kMoreWays = 6, kBriefly = 2000;
  const world::Robot& who = scenario_.robots[idx(robot)];
  const vehicle::Model& model = scenario_.model_of(who);
  const bool alone = scenario_.robots.size() == 1 && !who.rests_at_goal();
  const auto bumps = [&](std::uint64_t seed) {
    return whims(who.start.position(), who.goal->position(), model.length(), seed);
  };
  std::optional<Path> best;
  if (alone && options_.seed != 0) best = around(robot, bumps(options_.seed), {}, kPatience);
  if (!best) best = around(robot, {}, {}, kPatience);
  if (!alone || options_.seed != 0 || !options_.quickest || who.start_speed != 0.0) return best;
  if (!best || !changes_gear(*best) || best->wriggles) return best;
  double quickest = drive_time(*best, model);
  for (std::uint64_t seed = 1; seed <= kMoreWays && !options_.deadline.expired(); ++seed) {
    std::optional<Path> other = around(robot, bumps(seed), {}, kBriefly);
    if (!other) break;  // in places as tight as this the next would hardly fare better
    const double time = drive_time(*other, model);
    if (time < quickest) quickest = time, best = std::move(other);
  }
  return best;
}

}  // namespace seine::search
