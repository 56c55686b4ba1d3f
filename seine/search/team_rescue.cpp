// What a team search does when passes and repairs leave somebody without a motion.
#include <algorithm>
#include <utility>

#include "seine/geom/convex.hpp"
#include "seine/search/rescue.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {
namespace {

constexpr int kMostMakingWay = 24;  // ways kept for a car that may have to make way

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

// A path that a space-time search finds among the others, where the ways at hand lead nowhere or make it
// late.
TeamSearch::Placed TeamSearch::among(int robot, const TeamState& state, Placed best, int patience) {
  if (!sources_.among || (best && !late(robot, best->arrival))) return best;
  const std::vector<Traffic> traffic = coordinator_.traffic(robot, state);
  if (patience == 1) {
    const Placed placed = around_the_resting(robot, state, traffic);
    if (placed && (!best || placed->arrival < best->arrival)) best = placed;
    if (best && !late(robot, best->arrival)) return best;
  }
  for (const double pace : {0.7, 0.4}) {
    ++effort_.rescues;
    std::optional<Path> path = sources_.among(robot, traffic, {pace, patience, best != nullptr});
    if (!path) break;
    const Placed placed = place_along(robot, *path, state);
    if (placed && (!best || placed->arrival < best->arrival)) best = placed;
    if (placed) break;
  }
  return best;
}

// Who waits long for moving obstacles may be quicker around them.
void TeamSearch::overtake(TeamState& state) {
  const auto& obstacles = coordinator_.scenario().obstacles;
  if (std::all_of(obstacles.begin(), obstacles.end(), world::stands_still)) return;
  for (int robot = 0; robot < coordinator_.robots(); ++robot) {
    if (coordinator_.fixed(robot)) continue;
    TeamState others = state;
    others[idx(robot)] = nullptr;
    state[idx(robot)] = among(robot, others, state[idx(robot)], 0);
  }
}

// A path around where everything that moves comes to rest: all it may take beside it is patience.
TeamSearch::Placed TeamSearch::around_the_resting(int robot, const TeamState& state,
                                                  std::span<const Traffic> traffic) {
  std::vector<std::vector<geom::Vec2>> parked;
  for (const Traffic& other : traffic) {
    const auto last = other.body->polygon(static_cast<int>(other.body->events().size()) - 1);
    parked.push_back(geom::convex_hull({last.begin(), last.end()}));  // corners may fall together
  }
  ++effort_.paths;
  const std::optional<Path> path = sources_.search(robot, {}, parked, options_.parked_expansions);
  return path ? place_along(robot, *path, state) : nullptr;
}

// On a new path, carefully if it must be.
TeamSearch::Placed TeamSearch::place_along(int robot, const Path& path, const TeamState& state) {
  for (const bool careful : {false, true}) {
    const std::shared_ptr<Way> way = coordinator_.make_way(robot, path, careful);
    if (!way || !coordinator_.finish_way(*way)) continue;
    Placed placed = coordinator_.place_on(robot, way, state, workspace_);
    if (!placed) continue;
    keep(robot, way);
    return placed;
  }
  return nullptr;
}

// Where two cannot pass each other, one may wait beside its way: ways by such places are at hand from now on.
// Ends that stand at the margin to each other are reached carefully.
void TeamSearch::add_bays(const std::vector<int>& group) {
  for (const int robot : group)
    if (!coordinator_.ways(robot).empty())
      keep(robot, coordinator_.make_way(robot, fastest_way(robot)->lattice.path(), true));
  if (!sources_.by_bays) return;
  for (const int robot : group)
    for (const MakingWay::Other& other : others_of(robot, group))
      for (Path& path : sources_.by_bays(robot, fastest_way(robot)->lattice.path(), other))
        keep(robot, coordinator_.make_way(robot, std::move(path), true), kMostMakingWay);
}

// Those of the group that have a way, on their fastest.
std::vector<MakingWay::Other> TeamSearch::others_of(int robot, const std::vector<int>& group) const {
  std::vector<MakingWay::Other> others;
  if (coordinator_.ways(robot).empty()) return others;
  for (const int other : group)
    if (other != robot && !coordinator_.ways(other).empty())
      others.push_back({other, fastest_way(other)->lattice.path()});
  return others;
}

// The same by places that need not be beside the way. One that is off the ways of all others comes first.
void TeamSearch::add_refuges(const std::vector<int>& group) {
  if (!sources_.by_refuges) return;
  for (const int robot : group) {
    const std::vector<MakingWay::Other> others = others_of(robot, group);
    if (others.empty()) continue;
    const Path way = fastest_way(robot)->lattice.path();
    const auto add = [&](std::span<const MakingWay::Other> from) {
      for (Path& path : sources_.by_refuges(robot, way, from))
        keep(robot, coordinator_.make_way(robot, std::move(path), true), kMostMakingWay);
    };
    add(others);
    for (std::size_t i = 0; i < others.size() && others.size() > 1; ++i) add({&others[i], 1});
  }
}

bool TeamSearch::prove_hopeless(const std::vector<int>& group) {
  for (std::size_t i = 0; i < group.size() && sources_.cannot_both && !hopeless_; ++i)
    for (std::size_t j = i + 1; j < group.size() && !hopeless_; ++j)
      if (sources_.cannot_both(group[i], group[j])) hopeless_ = {group[i], group[j]};
  return hopeless_.has_value();
}

// Few cars: all of them once more, one after the other among those before. Many: each that has no motion
// together with those in its way.
bool TeamSearch::rescue(TeamState& state, const TeamState& given, const Deadline& deadline) {
  if (!sources_.among) return false;
  ++effort_.rescues;
  constexpr std::size_t kFew = 3;
  Rescue rescue(
      coordinator_,
      [this](int robot, const TeamState& others, Placed best, int patience) {
        return among(robot, others, best, patience);
      },
      workspace_);
  std::vector<int> free;
  for (int robot = 0; robot < coordinator_.robots(); ++robot)
    if (!given[idx(robot)]) free.push_back(robot);
  if (free.size() <= kFew) {
    add_bays(free);
    if (rescue.run(free, state, deadline, Rescue::by_ways())) return true;
    if (prove_hopeless(free)) return false;
    add_refuges(free);
    return rescue.run(free, state, deadline);
  }
  for (int robot = 0; robot < coordinator_.robots(); ++robot) {
    if (state[idx(robot)]) continue;
    std::vector<int> group{robot};
    if (rescue.run(group, state, deadline)) continue;
    for (const auto& conflict : coordinator_.conflicts(robot, *fastest_way(robot), state, workspace_))
      if (group.size() < kFew && conflict.robot >= 0 && !coordinator_.fixed(conflict.robot))
        group.push_back(conflict.robot);
    if (!rescue.run(group, state, deadline)) return false;
  }
  return true;
}

}  // namespace seine::search
