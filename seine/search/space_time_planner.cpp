#include "seine/search/space_time_planner.hpp"

#include <algorithm>

#include "seine/search/busy_ground.hpp"
#include "seine/search/path_planner.hpp"

namespace seine::search {
namespace {

// As in the path search (docs/front-end-paths.md), in car lengths and widths.
constexpr double kSlack = 0.025, kEaseRadius = 1.5, kDiscCell = 0.2;

constexpr double kWaiting = 0.2;  // a second of waiting against one of driving

// One search, lengths in turning radii.
struct Rung {
  double radius;  // of the smallest turning radius
  double step, min_step, cell;
  int headings;
  double slack;  // of the full slack
  int expansions;
};
// By patience.
constexpr Rung kRungs[] = {
    {1.1, 0.8, 0.4, 0.45, 24, 1.0, 400},
    {1.1, 0.8, 0.4, 0.45, 24, 1.0, 1500},
    {1.02, 0.4, 0.2, 0.25, 36, 0.2, 2500},
    {1.02, 0.4, 0.2, 0.25, 36, 0.2, 10000},
};

}  // namespace

SpaceTimePlanner::SpaceTimePlanner(const world::StaticMap& map, const vehicle::Model& model,
                                   const SpeedGrid& grid)
    : map_(map),
      model_(model),
      grid_(grid),
      distances_(map, kDiscCell * model.width(), 1.5 * model.length()),
      cover_(model.footprint),
      footprint_(model.footprint) {}

// More than the clearance only to what leaves that much at the start, at once, and at the goal, in the end.
std::vector<Traffic> SpaceTimePlanner::with_extra(const geom::Pose2& start, const geom::Pose2& goal,
                                                  std::span<const Traffic> traffic, double extra) const {
  std::vector<Traffic> wished(traffic.begin(), traffic.end());
  for (Traffic& other : wished) {
    other.clearance += extra;
    BusyGround ground({&other, 1}, footprint_, grid_.half_step(), 0.0);
    const std::span<const Span> at_start = ground.busy(start);
    bool tight = !at_start.empty() && at_start.front().begin <= 0.0;
    const std::span<const Span> at_goal = ground.busy(goal);
    tight = tight || (!at_goal.empty() && at_goal.back().end > 1e300);
    if (tight) other.clearance -= extra;
  }
  return wished;
}

std::optional<Path> SpaceTimePlanner::plan(const geom::Pose2& start, const geom::Pose2& goal,
                                           std::span<const Traffic> traffic,
                                           const SpaceTimeOptions& options) {
  const std::vector<Traffic> wished = with_extra(start, goal, traffic, options.extra);
  const DiscCover::Disc& disc = cover_.widest();
  const geom::Vec2 reference{disc.x, cover_.axis};
  const CostToGoCache::Loan to_go(
      cache_, {.distances = &distances_, .radius = disc.inner + options.clearance}, goal * reference);
  to_go.get()->until(options.deadline);
  FootprintChecker free(map_, &distances_, model_, options.clearance);
  const double room_start = free.exact_room(start), room_goal = free.exact_room(goal);
  const Rung& rung = kRungs[std::clamp(options.patience, 0, kMostPatience)];
  const double radius = rung.radius / model_.max_curvature();
  const double slack = rung.slack * kSlack * model_.length();
  FootprintChecker checker = free;
  checker.set_slack(slack);
  checker.ease_slack(start.position(), kEaseRadius * model_.length(),
                     std::max(0.0, std::min(slack, 0.5 * room_start)));
  checker.ease_slack(goal.position(), kEaseRadius * model_.length(),
                     std::max(0.0, std::min(slack, 0.5 * room_goal)));
  SpaceTimeProblem problem;
  problem.start = start;
  problem.goal = goal;
  problem.checker = &checker;
  problem.to_go = to_go.get();
  problem.reference = reference;
  problem.footprint = &footprint_;
  problem.grid = &grid_;
  problem.traffic = wished;
  problem.radius = radius;
  problem.deadline = options.deadline;
  SpaceTimeSettings settings;
  settings.step = rung.step * radius;
  settings.min_step = rung.min_step * radius;
  settings.cell = rung.cell * radius;
  settings.headings = rung.headings;
  settings.speed_share = options.pace;
  settings.waiting = options.hurry ? 1.0 : kWaiting;
  settings.max_expansions = rung.expansions;
  const SpaceTimeResult result = search_space_time(problem, settings);
  expansions_ += result.expansions;
  if (result.route) return sampled(*result.route, kPathSpacing * model_.length());
  return std::nullopt;
}

}  // namespace seine::search
