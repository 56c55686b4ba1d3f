#include "seine/search/team_search.hpp"

#include <algorithm>
#include <cmath>

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

double sum_of_arrivals(const TeamState& state) {
  double sum = 0.0;
  for (const auto& placement : state)
    if (placement) sum += placement->arrival;
  return sum;
}

TeamSearch::TeamSearch(Coordinator& coordinator, FindPath find_path, const TeamSearchOptions& options,
                       std::uint64_t seed)
    : coordinator_(coordinator),
      find_path_(std::move(find_path)),
      options_(options),
      rng_(seed),
      precedence_(coordinator) {}

bool TeamSearch::late(int robot, double arrival) const {
  const double alone = coordinator_.alone(robot);
  return arrival - alone > std::max(options_.late, options_.late_share * alone);
}

int TeamSearch::fastest_way(int robot) const {
  const auto& ways = coordinator_.ways(robot);
  const auto best = std::min_element(ways.begin(), ways.end(),
                                     [](const auto& a, const auto& b) { return a->alone < b->alone; });
  return static_cast<int>(best - ways.begin());
}

bool TeamSearch::solve(TeamState& state, const Deadline& deadline, std::span<const int> first_order) {
  const TeamState given = state;
  TeamState best = state;
  int most = -1;
  std::vector<double> keys;
  for (int i = 0; i < coordinator_.robots(); ++i) keys.push_back(coordinator_.alone(i));
  std::vector<int> order(first_order.begin(), first_order.end());
  if (order.empty()) order = precedence_.order(keys);
  for (int attempt = 0; attempt < options_.passes && !deadline.expired(); ++attempt) {
    state = given;
    const int failed = pass(order, state, deadline);
    if (failed < 0) return true;
    const auto placed = static_cast<int>(
        std::count_if(state.begin(), state.end(), [](const auto& p) { return p != nullptr; }));
    if (placed > most) {
      most = placed;
      best = state;
    }
    const auto at = std::find(order.begin(), order.end(), failed);
    if (attempt % 5 == 4) {
      for (double& key : keys) key = rng_.uniform();
      order = precedence_.order(keys);
    } else {  // to the front, every other time half way
      const auto to = attempt % 2 == 0 ? order.begin() : order.begin() + (at - order.begin()) / 2;
      std::rotate(to, at, at + 1);
    }
  }
  state = best;
  return false;
}

// Everybody in this order; returns the robot that found no motion, or −1.
int TeamSearch::pass(const std::vector<int>& order, TeamState& state, const Deadline& deadline) {
  for (const int robot : order) {
    if (state[idx(robot)]) continue;
    if (deadline.expired() || coordinator_.ways(robot).empty()) return robot;
    Placed placed = place(robot, state);
    if (!placed || late(robot, placed->arrival))
      placed = detour(robot, state, placed, placed ? options_.late_tries : options_.detour_tries);
    if (!placed) placed = around_the_parked(robot, state);
    state[idx(robot)] = placed;
    if (!placed && !make_room(robot, state)) return robot;
  }
  return -1;
}

TeamSearch::Placed TeamSearch::place(int robot, const TeamState& state) {
  return coordinator_.place(robot, state, workspace_);
}

// Other paths, pushed away from where the unhindered drive meets the others; the pushes add up.
TeamSearch::Placed TeamSearch::detour(int robot, const TeamState& state, Placed best, int tries) {
  if (!find_path_) return best;
  const world::Scenario& scenario = coordinator_.scenario();
  const double radius = options_.bump_lengths * scenario.model_of(scenario.robots[idx(robot)]).length();
  std::vector<Bump> bumps;
  int way = best ? best->way : fastest_way(robot);
  for (int i = 0; i < tries; ++i) {
    const auto conflicts = coordinator_.conflicts(robot, way, state);
    if (conflicts.empty()) break;
    const SpeedLattice& lattice = coordinator_.ways(robot)[idx(way)]->lattice;
    const geom::Pose2 there = pose_at(lattice.path(), lattice.s_at(conflicts.front().unit));
    bumps.push_back(
        {there * geom::Vec2{0.5 * radius / options_.bump_lengths, 0.0}, radius, options_.bump_weight});
    if (!add_way(robot, find_path_(robot, bumps, {}, options_.detour_expansions))) continue;
    way = static_cast<int>(coordinator_.ways(robot).size()) - 1;
    if (best && coordinator_.ways(robot).back()->alone >= best->arrival) continue;
    Placed placed = coordinator_.place_on(robot, way, state, workspace_);
    if (placed && (!best || placed->arrival < best->arrival)) best = placed;
    if (best && !late(robot, best->arrival)) break;
  }
  return best;
}

// A path that keeps off everybody who has not left yet or has arrived for good.
TeamSearch::Placed TeamSearch::around_the_parked(int robot, const TeamState& state) {
  if (!find_path_) return nullptr;
  const world::Scenario& scenario = coordinator_.scenario();
  const auto own_start = coordinator_.footprint_at(robot, scenario.robots[idx(robot)].start);
  const auto own_goal = coordinator_.footprint_at(robot, scenario.robots[idx(robot)].goal);
  std::vector<std::vector<geom::Vec2>> parked;
  const auto park = [&](std::vector<geom::Vec2> place) {
    const double margin = scenario.margins.robot;  // what overlaps the ends has to move anyway
    if (apart(place, own_start, margin) && apart(place, own_goal, margin)) parked.push_back(std::move(place));
  };
  for (int other = 0; other < coordinator_.robots(); ++other) {
    if (other == robot) continue;
    park(coordinator_.footprint_at(other, scenario.robots[idx(other)].goal));
    if (!state[idx(other)]) park(coordinator_.footprint_at(other, scenario.robots[idx(other)].start));
  }
  if (!add_way(robot, find_path_(robot, {}, parked, 4 * options_.detour_expansions))) return nullptr;
  return coordinator_.place_on(robot, static_cast<int>(coordinator_.ways(robot).size()) - 1, state,
                               workspace_);
}

bool TeamSearch::add_way(int robot, std::optional<Path> path) {
  if (!path || static_cast<int>(coordinator_.ways(robot).size()) >= options_.most_ways) return false;
  return coordinator_.add_way(robot, std::move(*path));
}

// Takes those out that block the robot, lets it go, and puts them back.
bool TeamSearch::make_room(int robot, TeamState& state) {
  TeamState trial = state;
  std::vector<int> out;
  for (const auto& conflict : coordinator_.conflicts(robot, fastest_way(robot), state)) {
    if (conflict.robot < 0 || coordinator_.fixed(conflict.robot)) continue;
    trial[idx(conflict.robot)] = nullptr;
    out.push_back(conflict.robot);
    if (static_cast<int>(out.size()) > options_.neighbours) break;
  }
  if (out.empty()) return false;
  out.insert(out.begin(), robot);
  if (!replace_group(out, trial)) return false;
  state = std::move(trial);
  return true;
}

bool TeamSearch::replace_group(const std::vector<int>& group, TeamState& state) {
  for (const int robot : group) {
    state[idx(robot)] = place(robot, state);
    if (!state[idx(robot)]) return false;
  }
  return true;
}

void TeamSearch::improve(TeamState& state, const Deadline& deadline) {
  std::vector<double> delay(state.size());
  double cost = sum_of_arrivals(state);
  const int rounds = static_cast<int>(options_.rounds * coordinator_.robots());
  for (int round = 0; round < rounds && !deadline.expired(); ++round) {
    double total = 0.0;
    for (int i = 0; i < coordinator_.robots(); ++i)
      total += delay[idx(i)] = coordinator_.fixed(i) ? 0.0 : state[idx(i)]->arrival - coordinator_.alone(i);
    constexpr double kNothing = 1e-6;
    if (total < kNothing) return;
    double pick = rng_.uniform(0.0, total);
    int robot = 0;
    while (robot + 1 < coordinator_.robots() && pick >= delay[idx(robot)]) pick -= delay[idx(robot++)];
    if (delay[idx(robot)] < kNothing) continue;
    TeamState trial = state;
    const std::vector<int> group = group_around(robot, trial);
    for (const int out : group) trial[idx(out)] = nullptr;
    if (!replace_group(group, trial)) continue;
    const double trial_cost = sum_of_arrivals(trial);
    if (trial_cost >= cost - kNothing) continue;
    cost = trial_cost;
    state = std::move(trial);
  }
}

// The late robot and some of those in its way, in a random order that puts it first more often than not.
std::vector<int> TeamSearch::group_around(int robot, const TeamState& state) {
  std::vector<int> group{robot};
  for (const auto& conflict : coordinator_.conflicts(robot, fastest_way(robot), state)) {
    if (static_cast<int>(group.size()) > options_.neighbours) break;
    if (conflict.robot >= 0 && !coordinator_.fixed(conflict.robot)) group.push_back(conflict.robot);
  }
  const int from = rng_.uniform() < 0.7 ? 1 : 0;
  for (int i = static_cast<int>(group.size()) - 1; i > from; --i)
    std::swap(group[idx(i)], group[idx(from + rng_.below(i - from + 1))]);
  return group;
}

}  // namespace seine::search
