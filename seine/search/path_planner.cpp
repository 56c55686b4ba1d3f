#include "seine/search/path_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

#include "seine/geom/convex.hpp"
#include "seine/search/cost_to_go_cache.hpp"
#include "seine/search/drive_time.hpp"
#include "seine/search/gates.hpp"
#include "seine/search/hybrid_astar.hpp"
#include "seine/search/quickest.hpp"
#include "seine/search/rungs.hpp"
#include "seine/search/short_move.hpp"
#include "seine/search/slot.hpp"

namespace seine::search {
namespace {

// All lengths scale with the car. Measured reasons: docs/front-end-paths.md.
constexpr double kLeastSlack = 0.1;    // of the slack: rungs with no more get along with what the ends have
constexpr double kEaseRadius = 1.5;    // car lengths around a tight start or goal in which it has less slack
constexpr double kShortStretch = 0.3;  // car lengths: stretches in one gear below this are avoided
constexpr double kQuicker = 0.9;       // a short move by words must save a tenth of the time
// m: an end with less room than this touches: it has none to turn in. The car may then come nearer by what is
// granted of the clearance; the certificate grants half as much again.
constexpr double kTouch = 1e-4, kGranted = 1e-4;
constexpr double kDiscCell =
    0.35;  // of the car's width: the side of a heuristic cell, small enough that walls stay tight

constexpr double kFineCell = 0.12;    // the same where it is in doubt whether a gap is wide enough
constexpr double kTightSlot = 0.1;    // car lengths of room: an end with more is no slot
constexpr double kComfort = 0.3;      // car widths on either side that a wary way likes to have
constexpr double kBlockedStep = 1.2;  // car lengths: moves that go on until they are blocked are no shorter
constexpr int kDiscomfort = 10;       // times the cost where it has not
// One try at wriggling: of the smallest radius; of the full slack; of the time of the tries before, to be
// preferred to them (1: only tried where they found nothing).
struct Wriggle {
  double radius, slack, quicker;
};
constexpr Wriggle kWriggles[] = {{1.1, 0.4, 1.0}, {1.03, 0.4, 0.95}, {1.03, 0.1, 1.0}, {1.0, 0.02, 1.0}};
constexpr int kWriggleShare = 20;         // of the expansions, for each
constexpr double kReverse = 1.5;          // what a metre backwards costs at least
constexpr double kSteeringChange = 0.05;  // turning radii, from straight to the tightest turn

/// What a metre backwards costs: at least the usual, at most the time it takes, forwards being 1; infinite
/// where the car has no reverse.
double reverse_cost(const vehicle::Limits& limits, double share) {
  if (!(limits.reverse_speed > 0.0)) return std::numeric_limits<double>::infinity();
  return kReverse + share * std::max(0.0, limits.speed / limits.reverse_speed - kReverse);
}

}  // namespace

struct PathPlanner::Impl {
  Impl(const world::StaticMap& map_in, const vehicle::Model& model_in)
      : map(map_in),
        model(model_in),
        length(model.length()),
        distances(map, kDiscCell * model.width(), 1.5 * length),
        cover(model.footprint),
        reference{cover.widest().x, cover.axis} {}

  FootprintChecker checker(const geom::Pose2& start, const geom::Pose2& goal,
                           const PathOptions& options) const;
  /// The ends of a way, and the room there.
  struct Ends {
    geom::Pose2 start, goal;
    double room_start, room_goal;
    bool touch() const { return std::min(room_start, room_goal) < 2.0 * kTouch; }
  };
  std::optional<Route> plan(const geom::Pose2& start, const geom::Pose2& goal, const PathOptions& options);
  std::optional<Route> through_gates(const Ends& ends, double most_room, const PathOptions& options,
                                     int& left);
  std::optional<Route> ladder(const geom::Pose2& start, const geom::Pose2& goal, const PathOptions& options,
                              int& left, bool gates);
  FootprintChecker slackened(const FootprintChecker& free, const Ends& ends, double share) const;
  std::optional<Route> wriggle(const FootprintChecker& free, const Ends& ends, const PathOptions& options,
                               int& left) const;
  void hurry(Route& route, const FootprintChecker& checker, const PathOptions& options);
  LatticeResult climb(const Rung& rung, const FootprintChecker& checker, const Route& ends, bool backwards,
                      const PathOptions& options, int expansions);
  geom::Pose2 turned_about_middle(const geom::Pose2& pose, double turn) const;

  DiscWay way(Gaps gaps, double clearance);
  /// The grid of the heuristic where passages are in doubt, made when first needed.
  const PointDistances& fine() {
    std::call_once(fine_made, [this] {
      fine_distances = std::make_unique<PointDistances>(map, kFineCell * model.width(), length);
    });
    return *fine_distances;
  }

  const world::StaticMap& map;
  vehicle::Model model;
  double length;
  PointDistances distances;
  std::once_flag fine_made;
  std::unique_ptr<PointDistances> fine_distances;
  DiscCover cover;
  geom::Vec2 reference;  // body frame: the middle of the widest disc inside the footprint
  CostToGoCache cache;
};

/// Parked cars that the start or the goal is too close to anyway are nobody's business here: who goes first
/// settles them.
FootprintChecker PathPlanner::Impl::checker(const geom::Pose2& start, const geom::Pose2& goal,
                                            const PathOptions& options) const {
  FootprintChecker checker(map, &distances, model, options.clearance);
  if (std::min(checker.exact_room(start), checker.exact_room(goal)) < kTouch)
    checker = FootprintChecker(map, &distances, model, options.clearance - kGranted);
  const geom::Convex body{model.footprint};
  const geom::Convex at_start = geom::placed(body, start), at_goal = geom::placed(body, goal);
  const geom::Box start_box = at_start.box(), goal_box = at_goal.box();
  for (const auto& footprint : options.parked) {
    const geom::Box box = geom::bounding_box(footprint).inflated(options.parked_clearance);
    if (box.overlaps(start_box) && geom::distance(at_start.core, footprint) < options.parked_clearance)
      continue;
    if (box.overlaps(goal_box) && geom::distance(at_goal.core, footprint) < options.parked_clearance)
      continue;
    checker.park(footprint, options.parked_clearance);
  }
  return checker;
}

DiscWay PathPlanner::Impl::way(Gaps gaps, double clearance) {
  DiscWay way;
  way.distances = gaps == Gaps::quick ? &distances : &fine();
  way.radius = cover.widest().inner + clearance;
  if (gaps == Gaps::wary) {
    way.comfort = way.radius + kComfort * model.width();
    way.discomfort = kDiscomfort;
  }
  return way;
}

/// One rung: the way between the ends of `ends`; when `backwards`, as the car will drive it the other way
/// round.
LatticeResult PathPlanner::Impl::climb(const Rung& rung, const FootprintChecker& checker, const Route& ends,
                                       bool backwards, const PathOptions& options, int expansions) {
  const double radius = rung.radius / model.max_curvature();
  const CostToGoCache::Loan to_go(cache, way(rung.gaps, options.clearance), ends.goal * reference);
  to_go.get()->until(options.deadline);
  LatticeProblem problem;
  problem.start = ends.start;
  problem.goal = ends.goal;
  problem.checker = &checker;
  problem.to_go = to_go.get();
  problem.reference = reference;
  problem.deadline = options.deadline;
  problem.costs.radius = radius;
  const double reverse = reverse_cost(model.limits, rung.slow_reverse);
  problem.costs.driving.forward = backwards ? reverse : 1.0;
  problem.costs.driving.reverse = backwards ? 1.0 : reverse;
  problem.costs.driving.gear_change = rung.gear_change * radius;
  problem.costs.steering_change = kSteeringChange;
  problem.costs.short_stretch = kShortStretch * length;
  problem.costs.bumps = options.bumps;
  LatticeSettings settings;
  settings.step = rung.step * radius;
  if (rung.until_blocked) settings.step = std::max(settings.step, kBlockedStep * length);
  settings.min_step = rung.min_step * radius;
  settings.cell = rung.cell * radius;
  settings.until_blocked = rung.until_blocked;
  settings.gears_apart = rung.gears_apart;
  settings.headings = rung.headings;
  const int backward = std::isfinite(reverse) ? rung.backward : 0;
  settings.forward = backwards ? backward : rung.forward;
  settings.backward = backwards ? rung.forward : backward;
  settings.heuristic_weight = options.heuristic_weight;
  settings.max_expansions = expansions;
  LatticeResult result = search_lattice(problem, settings);
  if (result.route) shorten(*result.route, checker, problem.costs);
  return result;
}

/// The checker with a share of the full slack, less of it about tight ends.
FootprintChecker PathPlanner::Impl::slackened(const FootprintChecker& free, const Ends& ends,
                                              double share) const {
  FootprintChecker checker = free;
  double slack = share * kSearchSlack * length;
  if (share <= kLeastSlack && ends.touch())
    slack = std::min(slack, 0.5 * std::min(ends.room_start, ends.room_goal));
  checker.set_slack(slack);
  checker.ease_slack(ends.start.position(), kEaseRadius * length, std::min(slack, 0.5 * ends.room_start));
  checker.ease_slack(ends.goal.position(), kEaseRadius * length, std::min(slack, 0.5 * ends.room_goal));
  return checker;
}

/// Looks for ways that take less time than the one found: other words, and searches to which other turns and
/// gear changes are dear.
void PathPlanner::Impl::hurry(Route& route, const FootprintChecker& checker, const PathOptions& options) {
  take_quickest_word(route, checker, kLadder[0].radius / model.max_curvature());
  const bool slow = slow_reverse(model.limits);
  if (route.arcs.size() <= 5 && !slow) return;
  for (const Rung& rung : kHurried) {
    if (rung.slow_reverse > 0.0 && !slow) continue;
    const LatticeResult result = climb(rung, checker, Route{route.start, route.goal, {}}, false, options,
                                       std::max(150, static_cast<int>(rung.share * options.max_expansions)));
    if (result.route && quicker(*result.route, route, model)) route = *result.route;
  }
}

/// From gate to gate, each leg a search of its own that begins and ends in a narrow place. Through a gate the
/// car goes nose first if it can, else backwards.
std::optional<Route> PathPlanner::Impl::through_gates(const Ends& ends, double most_room,
                                                      const PathOptions& options, int& left) {
  const DiscWay disc = way(Gaps::wary, options.clearance);
  std::vector<Gate> gates;
  {
    const CostToGoCache::Loan to_go(cache, disc, ends.goal * reference);
    to_go.get()->until(options.deadline);
    gates =
        gates_between(map, model, *to_go.get(), disc, reference, ends.start, ends.goal, options.clearance);
  }
  const bool narrow =
      std::any_of(gates.begin(), gates.end(), [&](const Gate& gate) { return gate.room <= most_room; });
  if (!narrow) return std::nullopt;
  for (const double turn : {0.0, std::numbers::pi}) {
    Route whole{ends.start, ends.goal, {}};
    geom::Pose2 from = ends.start;
    bool found = true;
    for (std::size_t i = 0; i <= gates.size() && found; ++i) {
      geom::Pose2 to = ends.goal;
      if (i < gates.size()) to = turned_about_middle(gates[i].pose, turn);
      const std::optional<Route> route = ladder(from, to, options, left, false);
      found = route.has_value();
      if (found) whole.arcs.insert(whole.arcs.end(), route->arcs.begin(), route->arcs.end());
      from = to;
    }
    if (!found) continue;
    merge(whole.arcs);
    return whole;
  }
  return std::nullopt;
}

/// The same place, facing the other way by `turn`: the footprint's middle stays.
geom::Pose2 PathPlanner::Impl::turned_about_middle(const geom::Pose2& pose, double turn) const {
  const geom::Box box = geom::bounding_box(model.footprint);
  const geom::Vec2 middle = 0.5 * (box.low + box.high), at = pose * middle;
  const double heading = geom::wrap_angle(pose.heading + turn);
  const geom::Vec2 axle = at - geom::Pose2{0.0, 0.0, heading} * middle;
  return {axle.x, axle.y, heading};
}

/// Climbs the ladder until a rung finds a way; `left` expansions may be used and are counted down.
std::optional<Route> PathPlanner::Impl::ladder(const geom::Pose2& start, const geom::Pose2& goal,
                                               const PathOptions& options, int& left, bool gates) {
  const FootprintChecker free = checker(start, goal, options);
  const Ends ends{start, goal, free.exact_room(start), free.exact_room(goal)};
  if (std::min(ends.room_start, ends.room_goal) < 0.0) return std::nullopt;

  // Whether there may be an end that can only be left or reached by moves shorter than a step.
  bool slot = std::min(ends.room_start, ends.room_goal) < kTightSlot * length, wriggled = !slot;
  for (const Rung& rung : kLadder) {
    if (left <= 0 || options.deadline.expired()) break;
    if (rung.for_slots && !slot) continue;
    if (!wriggled && (rung.for_slots || (options.quickest && &rung != kLadder))) {
      wriggled = true;
      if (std::optional<Route> route = wriggle(free, ends, options, left)) return route;
    }
    const FootprintChecker checker = slackened(free, ends, rung.slack);
    // The way out of a tight place is easier to find than the way in: search from there.
    const bool backwards = rung.from_tighter_end && ends.room_goal < ends.room_start;
    const int expansions =
        std::min(left, std::max(150, static_cast<int>(rung.share * options.max_expansions)));
    LatticeResult result = climb(rung, checker, backwards ? Route{goal, start, {}} : Route{start, goal, {}},
                                 backwards, options, expansions);
    if (result.unreachable) return std::nullopt;
    if (result.route) {
      Route route = backwards ? reversed(*result.route) : *std::move(result.route);
      if (options.quickest) hurry(route, slackened(free, ends, 1.0), options);
      return route;
    }
    left -= result.expansions;
    if (rung.words_after && ends.touch()) {
      Route route{start, goal, {}};
      if (take_quickest_word(route, slackened(free, ends, 0.0), rung.radius / model.max_curvature()))
        return route;
    }
    slot = slot || result.exhausted;
    if (gates && rung.gates_after > 0.0)
      if (std::optional<Route> route = through_gates(ends, rung.gates_after * length, options, left))
        return route;
  }
  return std::nullopt;
}

/// Out of a tight end or into it forth and back, with less and less slack; tighter turns where they save
/// much.
std::optional<Route> PathPlanner::Impl::wriggle(const FootprintChecker& free, const Ends& ends,
                                                const PathOptions& options, int& left) const {
  const bool leaving = ends.room_start <= ends.room_goal;
  std::optional<Route> best;
  for (const auto [radius, slack, quicker] : kWriggles) {
    if (best && !(quicker < 1.0)) break;
    const FootprintChecker checker = slackened(free, ends, slack);
    const SlotProblem problem{.inside = leaving ? ends.start : ends.goal,
                              .outside = leaving ? ends.goal : ends.start,
                              .leaving = leaving,
                              .checker = &checker,
                              .radius = radius / model.max_curvature(),
                              .bumps = options.bumps,
                              .max_expansions = std::min(left, options.max_expansions / kWriggleShare),
                              .deadline = options.deadline};
    SlotResult result = search_slot(problem);
    left -= result.expansions;
    if (!result.route) continue;
    if (best && !(drive_time(result.route->arcs, model) < quicker * drive_time(best->arcs, model))) continue;
    best = std::move(result.route);
    best->wriggles = true;
  }
  return best;
}

std::optional<Route> PathPlanner::Impl::plan(const geom::Pose2& start, const geom::Pose2& goal,
                                             const PathOptions& options) {
  // The ladder counts metres and likes long stretches; for a goal close by seconds decide.
  std::optional<Route> move;
  if (options.short_moves && options.bumps.empty())
    move = short_move(start, goal, checker(start, goal, options));
  if (move && move->arcs.size() == 1 && move->arcs.front().curvature == 0.0) return move;
  int left = options.max_expansions;
  std::optional<Route> route = ladder(start, goal, options, left, true);
  if (move &&
      (!route || smooth_drive_time(move->arcs, model) < kQuicker * smooth_drive_time(route->arcs, model)))
    return move;
  return route;
}

bool slow_reverse(const vehicle::Limits& limits) {
  return limits.speed > kReverse * limits.reverse_speed;
}

PathPlanner::PathPlanner(const world::StaticMap& map, const vehicle::Model& model)
    : impl_(std::make_unique<Impl>(map, model)) {}
PathPlanner::~PathPlanner() = default;
PathPlanner::PathPlanner(PathPlanner&&) noexcept = default;

std::optional<Path> PathPlanner::plan(const geom::Pose2& start, const geom::Pose2& goal,
                                      const PathOptions& options) const {
  const std::optional<Route> route = impl_->plan(start, goal, options);
  if (!route) return std::nullopt;
  Path path = sampled(*route, kPathSpacing * impl_->length);
  path.wriggles = route->wriggles;
  return path;
}

}  // namespace seine::search
