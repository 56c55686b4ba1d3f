#include "seine/search/rescue.hpp"

#include <algorithm>

#include "seine/search/space_time_planner.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {
namespace {

// How long the first car waits at its start, in times it needs alone.
constexpr double kDelays[] = {0.0, 0.5, 1.0, 2.0};
constexpr int kMostOrders = 6;

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

bool Rescue::run(std::span<const int> group, TeamState& state, const Deadline& deadline, Rounds rounds) {
  std::vector<int> order(group.begin(), group.end());
  std::sort(order.begin(), order.end());
  TeamState without = state;
  for (const int robot : order) without[idx(robot)] = nullptr;
  for (int patience = rounds.first; patience <= rounds.last; ++patience)
    for (const double delay : delays(order, patience)) {
      TeamState best = best_of_orders(order, delay, patience, without, deadline);
      if (best.empty()) continue;
      state = std::move(best);
      return true;
    }
  return false;
}

// s. While ways by bays and refuges are tried, the others may need as long as the longest of them takes.
std::vector<double> Rescue::delays(const std::vector<int>& order, int patience) const {
  if (order.size() < 2) return {0.0};
  double alone = 0.0, longest = 0.0;
  for (const int robot : order) {
    if (coordinator_.ways(robot).empty()) continue;
    alone = std::max(alone, coordinator_.alone(robot));
    for (const WayPtr& way : coordinator_.ways(robot)) longest = std::max(longest, way->alone);
  }
  std::vector<double> delays;
  for (const double share : kDelays) delays.push_back(share * alone);
  if (patience == kNoSearch && longest > delays.back()) delays.push_back(longest);
  return delays;
}

TeamState Rescue::best_of_orders(std::vector<int> order, double delay, int patience, const TeamState& without,
                                 const Deadline& deadline) {
  TeamState best;
  int tried = 0;
  do {
    if (deadline.expired()) break;
    TeamState trial = without;
    if (!attempt(order, delay, patience, trial)) continue;
    settle(order, trial);
    if (best.empty() || sum_of_arrivals(trial) < sum_of_arrivals(best)) best = std::move(trial);
  } while (++tried < kMostOrders && std::next_permutation(order.begin(), order.end()));
  return best;
}

bool Rescue::attempt(const std::vector<int>& order, double delay, int patience, TeamState& state) {
  for (const int robot : order) {
    const bool waits = robot == order.front() && delay > 0.0;
    Placed placed;
    if (waits) {
      for (const WayPtr& way : coordinator_.ways(robot)) {
        Placed other = coordinator_.place_after(delay, robot, way, state, workspace_);
        if (other && (!placed || other->arrival < placed->arrival)) placed = std::move(other);
      }
    } else {
      placed = coordinator_.place(robot, state, workspace_);
      if (patience != kNoSearch) placed = among_(robot, state, std::move(placed), patience);
    }
    if (!placed) return false;
    state[idx(robot)] = std::move(placed);
  }
  return true;
}

// Each once more among the others, as soon as it can.
void Rescue::settle(const std::vector<int>& order, TeamState& state) {
  constexpr int kRounds = 2;
  constexpr double kWorthwhile = 1e-3;  // s
  for (int round = 0; round < kRounds; ++round)
    for (const int robot : order) {
      const double arrival = state[idx(robot)]->arrival;
      TeamState others = state;
      others[idx(robot)] = nullptr;
      Placed sooner = coordinator_.place(robot, others, workspace_, arrival - kWorthwhile);
      if (sooner) state[idx(robot)] = std::move(sooner);
    }
}

}  // namespace seine::search
