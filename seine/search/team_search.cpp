#include "seine/search/team_search.hpp"

#include <algorithm>
#include <limits>

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

int unplaced(const TeamState& state) {
  return static_cast<int>(std::count(state.begin(), state.end(), nullptr));
}

}  // namespace

double sum_of_arrivals(const TeamState& state) {
  double sum = 0.0;
  for (const auto& placement : state)
    if (placement) sum += placement->arrival;
  return sum;
}

TeamSearch::TeamSearch(Coordinator& coordinator, Sources sources, const TeamSearchOptions& options,
                       std::uint64_t seed)
    : coordinator_(coordinator),
      sources_(std::move(sources)),
      options_(options),
      rng_(seed),
      precedence_(coordinator),
      futile_(static_cast<std::size_t>(coordinator.robots()), 0) {}

bool TeamSearch::late(int robot, double arrival) const {
  const double alone = coordinator_.alone(robot);
  return arrival - alone > std::max(options_.late, options_.late_share * alone);
}

WayPtr TeamSearch::fastest_way(int robot) const {
  const auto& ways = coordinator_.ways(robot);
  return *std::min_element(ways.begin(), ways.end(),
                           [](const WayPtr& a, const WayPtr& b) { return a->alone < b->alone; });
}

bool TeamSearch::solve(TeamState& state, const Deadline& deadline, std::span<const int> first_order) {
  const TeamState given = state;
  TeamState best;
  searches_ = effort_.paths + static_cast<int>(options_.rescuing_paths * coordinator_.robots());
  int fewest = coordinator_.robots() + 1;
  std::vector<double> keys;
  for (int i = 0; i < coordinator_.robots(); ++i) keys.push_back(coordinator_.alone(i));
  std::vector<int> order(first_order.begin(), first_order.end());
  if (order.empty()) order = precedence_.order(keys);
  for (int attempt = 0; attempt < options_.passes && !deadline.expired(); ++attempt) {
    state = given;
    pass(order, state, deadline);
    repair(state, deadline);
    const int left = unplaced(state);
    if (left == 0 || (attempt == 0 && rescue(state, given, deadline))) {
      overtake(state);
      return true;
    }
    if (left < fewest) {
      fewest = left;
      best = state;
    }
    if (hopeless_) break;
    for (double& key : keys) key = rng_.uniform();
    order = precedence_.order(keys);
  }
  if (!best.empty()) state = best;
  return false;
}

// Everybody in this order; who finds no motion is left out.
void TeamSearch::pass(const std::vector<int>& order, TeamState& state, const Deadline& deadline) {
  for (const int robot : order)
    if (!state[idx(robot)] && !deadline.expired() && !coordinator_.ways(robot).empty())
      state[idx(robot)] = place_somehow(robot, state);
}

// With new paths where the ways at hand lead nowhere.
TeamSearch::Placed TeamSearch::place_somehow(int robot, const TeamState& state) {
  Placed placed = place(robot, state);
  if (!placed || late(robot, placed->arrival)) placed = side_step(robot, state, placed);
  if (!placed) placed = detour(robot, state, placed, options_.detour_tries);
  if (!placed) placed = around_the_parked(robot, state, true);
  return placed;
}

// Takes somebody who has no motion, lets it go where others are in its way, and tries to put those back. Who
// is left out changes; the number of them never grows.
void TeamSearch::repair(TeamState& state, const Deadline& deadline) {
  const int left = unplaced(state);
  const int rounds = options_.repairs_each * left;
  for (int round = 0; round < rounds && !deadline.expired() && unplaced(state) > 0; ++round) {
    int robot = rng_.below(coordinator_.robots());
    while (state[idx(robot)] || coordinator_.ways(robot).empty()) robot = (robot + 1) % coordinator_.robots();
    const int ways = static_cast<int>(coordinator_.ways(robot).size());
    const WayPtr way =
        rng_.uniform() < 0.5 ? fastest_way(robot) : coordinator_.ways(robot)[idx(rng_.below(ways))];
    TeamState trial = state;
    std::vector<int> out;
    for (const auto& conflict : coordinator_.conflicts(robot, *way, state, workspace_)) {
      if (conflict.robot < 0 || coordinator_.fixed(conflict.robot)) continue;
      out.push_back(conflict.robot);
      trial[idx(conflict.robot)] = nullptr;
    }
    // Two that stand nose to nose: one must back off, which no path does that does not see the other.
    if (rng_.uniform() < 0.5) trial[idx(robot)] = around_the_parked(robot, trial, rng_.uniform() < 0.5);
    if (!trial[idx(robot)]) trial[idx(robot)] = coordinator_.place_on(robot, way, trial, workspace_);
    if (!trial[idx(robot)]) trial[idx(robot)] = place(robot, trial);
    if (!trial[idx(robot)]) continue;
    shuffle(out, 0);
    for (const int other : out) trial[idx(other)] = place_somehow(other, trial);
    if (unplaced(trial) <= unplaced(state)) state = std::move(trial);
  }
}

void TeamSearch::shuffle(std::vector<int>& list, int from) {
  for (int i = static_cast<int>(list.size()) - 1; i > from; --i)
    std::swap(list[idx(i)], list[idx(from + rng_.below(i - from + 1))]);
}

TeamSearch::Placed TeamSearch::place(int robot, const TeamState& state) {
  ++effort_.placements;
  return coordinator_.place(robot, state, workspace_);
}

// Passes the first robot it meets on the other side, or further out.
TeamSearch::Placed TeamSearch::side_step(int robot, const TeamState& state, Placed best, double latest) {
  if (!sources_.side_step) return best;
  const WayPtr way = best ? best->way : fastest_way(robot);
  const auto conflicts = coordinator_.conflicts(robot, *way, state, workspace_);
  if (conflicts.empty()) return best;
  const world::Scenario& scenario = coordinator_.scenario();
  const vehicle::Model& model = scenario.model_of(scenario.robots[idx(robot)]);
  const double width = model.width() + scenario.margins.robot, length = model.length();
  constexpr double kLane = 4.0;  // car lengths
  const double s = way->lattice.s_at(conflicts.front().unit);
  const auto attempt = [&](double offset, double beside_for) {
    std::optional<Path> path = sources_.side_step(robot, way->lattice.path(), s, offset, beside_for);
    if (best) latest = std::min(latest, best->arrival - 1e-3);
    if (!path || path->length() / way->lattice.grid().speed > latest) return false;
    const std::shared_ptr<Way> beside = coordinator_.make_way(robot, std::move(*path));
    if (!beside) return false;
    ++effort_.side_steps;
    const Placed placed = coordinator_.place_on(robot, beside, state, workspace_, latest);
    if (!placed || !keep(robot, beside)) return false;
    best = placed;
    return true;
  };
  bool found = false;
  for (const double offset : {-1.15, 1.15, -2.3, 2.3}) found = attempt(offset * width, length) || found;
  // Where lanes are narrow half a width is all there is, and it takes a while to pass.
  if (!found)
    for (const double offset : {-0.6, 0.6, -1.15, 1.15}) attempt(offset * width, kLane * length);
  return best;
}

// Other paths, pushed away from where the unhindered drive meets the others; the pushes add up.
TeamSearch::Placed TeamSearch::detour(int robot, const TeamState& state, Placed best, int tries) {
  const world::Scenario& scenario = coordinator_.scenario();
  const double length = scenario.model_of(scenario.robots[idx(robot)]).length();
  std::vector<Bump> bumps;
  WayPtr way = best ? best->way : fastest_way(robot);
  for (int i = 0; i < tries && may_search(); ++i) {
    const auto conflicts = coordinator_.conflicts(robot, *way, state, workspace_);
    if (conflicts.empty()) break;
    const geom::Pose2 there = pose_at(way->lattice.path(), way->lattice.s_at(conflicts.front().unit));
    bumps.push_back(
        {there * geom::Vec2{0.5 * length, 0.0}, options_.bump_lengths * length, options_.bump_weight});
    ++effort_.paths;
    const WayPtr around = keep_path(robot, sources_.search(robot, bumps, {}, options_.detour_expansions));
    if (!around) continue;
    way = around;
    if (best && way->alone >= best->arrival) continue;
    const Placed placed = coordinator_.place_on(robot, way, state, workspace_);
    if (placed && (!best || placed->arrival < best->arrival)) best = placed;
    if (best && !late(robot, best->arrival)) break;
  }
  return best;
}

// A path that keeps off everybody who has no motion yet and, if asked for, off all goals.
TeamSearch::Placed TeamSearch::around_the_parked(int robot, const TeamState& state, bool goals) {
  constexpr int kMostFailures = 2;
  if (!may_search() || futile_[idx(robot)] >= kMostFailures) return nullptr;
  const world::Scenario& scenario = coordinator_.scenario();
  const auto own_start = coordinator_.footprint_at(robot, scenario.robots[idx(robot)].start);
  const auto own_goal = coordinator_.footprint_at(robot, *scenario.robots[idx(robot)].goal);
  std::vector<std::vector<geom::Vec2>> parked;
  const auto park = [&](std::vector<geom::Vec2> place) {
    const double margin = scenario.margins.robot;  // what overlaps the ends has to move anyway
    if (apart(place, own_start, margin) && apart(place, own_goal, margin)) parked.push_back(std::move(place));
  };
  for (int other = 0; other < coordinator_.robots(); ++other) {
    if (other == robot) continue;
    if (goals) park(coordinator_.footprint_at(other, *scenario.robots[idx(other)].goal));
    if (!state[idx(other)]) park(coordinator_.footprint_at(other, scenario.robots[idx(other)].start));
  }
  ++effort_.paths;
  const WayPtr way = keep_path(robot, path_around(robot, std::move(parked)));
  if (!way) ++futile_[idx(robot)];
  if (!way) return nullptr;
  return coordinator_.place_on(robot, way, state, workspace_);
}

// Repairs ask again and again for a way around the same cars.
const std::optional<Path>& TeamSearch::path_around(int robot, std::vector<std::vector<geom::Vec2>> parked) {
  for (const Around& known : around_)
    if (known.robot == robot && known.parked == parked) return known.path;
  std::optional<Path> path = sources_.search(robot, {}, parked, options_.parked_expansions);
  around_.push_back({robot, std::move(parked), std::move(path)});
  return around_.back().path;
}

bool TeamSearch::may_search() const {
  return sources_.search && effort_.paths < searches_;
}

// When there are too many, another one than the first goes.
bool TeamSearch::keep(int robot, const std::shared_ptr<Way>& way, int most) {
  if (!way || !coordinator_.finish_way(*way)) return false;
  const int count = static_cast<int>(coordinator_.ways(robot).size());
  if (count >= std::max(most, options_.most_ways)) coordinator_.drop_way(robot, 1 + rng_.below(count - 1));
  coordinator_.keep_way(robot, way);
  return true;
}

std::shared_ptr<Way> TeamSearch::keep_path(int robot, std::optional<Path> path) {
  if (!path) return nullptr;
  std::shared_ptr<Way> way = coordinator_.make_way(robot, std::move(*path));
  return keep(robot, way) ? way : nullptr;
}

// Puts the group back, one after the other; false as soon as somebody cannot go, or the sum of their arrivals
// can no longer stay below `limit`.
bool TeamSearch::replace_group(const std::vector<int>& group, TeamState& state, double limit) {
  for (const int robot : group) limit -= coordinator_.alone(robot);
  for (const int robot : group) {
    limit += coordinator_.alone(robot);
    ++effort_.placements;
    state[idx(robot)] = coordinator_.place(robot, state, workspace_, limit);
    if (!state[idx(robot)] && rng_.uniform() < 0.3)
      state[idx(robot)] = side_step(robot, state, nullptr, limit);
    if (!state[idx(robot)]) return false;
    limit -= state[idx(robot)]->arrival;
  }
  return true;
}

void TeamSearch::improve(TeamState& state, const Deadline& deadline) {
  const int rounds = static_cast<int>(options_.rounds * coordinator_.robots());
  searches_ = effort_.paths + static_cast<int>(options_.improving_paths * coordinator_.robots());
  for (int round = 0; round < rounds && !deadline.expired(); ++round) {
    const int robot = pick_late(state);
    if (robot < 0) return;
    if (rng_.uniform() < 0.5) {
      TeamState others = state;
      others[idx(robot)] = nullptr;
      state[idx(robot)] = side_step(robot, others, state[idx(robot)]);
    }
    if (effort_.paths < searches_ && late(robot, state[idx(robot)]->arrival) && rng_.uniform() < 0.5) {
      TeamState others = state;
      others[idx(robot)] = nullptr;
      state[idx(robot)] = detour(robot, others, state[idx(robot)], 1);
    }
    TeamState trial = state;
    const std::vector<int> group = group_around(robot, trial);
    double before = 0.0;
    for (const int out : group) {
      before += state[idx(out)]->arrival;
      trial[idx(out)] = nullptr;
    }
    constexpr double kWorthwhile = 1e-3;  // s
    if (replace_group(group, trial, before - kWorthwhile)) state = std::move(trial);
  }
}

// A robot at random, in proportion to its delay; −1 when nobody is late at all.
int TeamSearch::pick_late(const TeamState& state) {
  constexpr double kNothing = 1e-3;  // s
  std::vector<double> upto(state.size());
  double total = 0.0;
  for (int i = 0; i < coordinator_.robots(); ++i) {
    const double delay = coordinator_.fixed(i) ? 0.0 : state[idx(i)]->arrival - coordinator_.alone(i);
    upto[idx(i)] = total += delay < kNothing ? 0.0 : delay;
  }
  if (total <= 0.0) return -1;
  const double pick = rng_.uniform(0.0, total);
  return static_cast<int>(std::upper_bound(upto.begin(), upto.end(), pick) - upto.begin());
}

// The late robot and some of those in its way, in a random order that puts it first more often than not.
std::vector<int> TeamSearch::group_around(int robot, const TeamState& state) {
  std::vector<int> group{robot};
  for (const auto& conflict : coordinator_.conflicts(robot, *fastest_way(robot), state, workspace_)) {
    if (static_cast<int>(group.size()) > options_.neighbours) break;
    if (conflict.robot >= 0 && !coordinator_.fixed(conflict.robot)) group.push_back(conflict.robot);
  }
  const int from = rng_.uniform() < 0.7 ? 1 : 0;
  shuffle(group, from);
  return group;
}

}  // namespace seine::search
