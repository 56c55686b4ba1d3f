#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/base/rng.hpp"
#include "seine/search/coordinator.hpp"
#include "seine/search/making_way.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/precedence.hpp"

namespace seine::search {

/// How much is tried. All budgets are counts, not seconds, so that the answer does not depend on the machine.
struct TeamSearchOptions {
  int passes = 4;                 ///< priority passes, each with its repairs, until everybody has a motion
  int repairs_each = 12;          ///< rounds of repair for each robot that a pass leaves without a motion
  int detour_tries = 3;           ///< paths asked for when a robot cannot go at all
  int detour_expansions = 150;    ///< of one such search
  int parked_expansions = 10000;  ///< of a search around everybody who stands: tight places need patience
  double late = 1.0;  ///< s, a delay worth a detour, or `late_share` of the time alone when that is longer
  double late_share = 0.2;
  int most_ways = 8;             ///< kept for one robot
  double rounds = 2.0;           ///< neighbourhoods tried for each robot after everybody has a motion
  double rescuing_paths = 3.0;   ///< paths searched for, at most, for each robot until everybody has a motion
  double improving_paths = 0.1;  ///< paths asked for in that time, for each robot
  int neighbours = 4;            ///< robots taken out together with the late one
  double bump_lengths = 2.1;     ///< radius of the places to avoid, in car lengths
  double bump_weight = 2.5;      ///< what a metre in them costs
};

/// Decides who goes when and along which of its ways: priority passes with detours until everybody has a
/// motion, then a large neighbourhood search that takes small groups out and puts them back in another order
/// while the sum of arrivals falls.
class TeamSearch {
 public:
  /// Where other paths come from. Both may be empty: then the ways at hand must do. Called from one thread.
  struct Sources {
    /// A path around the bumps and the parked.
    std::function<std::optional<Path>(int robot, std::span<const Bump> bumps,
                                      std::span<const std::vector<geom::Vec2>> parked, int expansions)>
        search;
    /// The path shifted to the left by `offset` m from `beside` m before to `beside` m after its driven
    /// length s.
    std::function<std::optional<Path>(int robot, const Path& path, double s, double offset, double beside)>
        side_step;
    /// A path that can be driven in time among the traffic.
    struct Among {
      double pace;   ///< of the car's speed where it drives
      int patience;  ///< as SpaceTimeOptions
      bool hurry;    ///< likewise
    };
    std::function<std::optional<Path>(int robot, std::span<const Traffic> traffic, const Among& how)> among;
    /// As MakingWay.
    std::function<std::vector<Path>(int robot, const Path& way, const MakingWay::Other& other)> by_bays;
    std::function<std::vector<Path>(int robot, const Path& way, std::span<const MakingWay::Other> others)>
        by_refuges;
    /// Whether it is proved that not both can arrive.
    std::function<bool(int a, int b)> cannot_both;
  };

  TeamSearch(Coordinator& coordinator, Sources sources, const TeamSearchOptions& options, std::uint64_t seed);

  /// Tries until every robot has a motion. Robots that have one in `state` (the fixed) keep it. False:
  /// `state` holds the pass that came furthest.
  bool solve(TeamState& state, const Deadline& deadline, std::span<const int> first_order = {});
  /// What it took so far.
  struct Effort {
    int paths = 0;       ///< searched for
    int side_steps = 0;  ///< that were free of obstacles
    int placements = 0;  ///< velocity plans among the others, over all ways
    int rescues = 0;     ///< rescues begun, and space-time searches
  };
  const Effort& effort() const { return effort_; }
  /// Two robots of which it is proved that not both can arrive, if that is why there is no solution.
  const std::optional<std::pair<int, int>>& hopeless() const { return hopeless_; }
  /// Lowers the sum of arrivals of a complete state; never makes it worse.
  void improve(TeamState& state, const Deadline& deadline);

 private:
  using Placed = std::shared_ptr<const Placement>;
  void pass(const std::vector<int>& order, TeamState& state, const Deadline& deadline);
  Placed place(int robot, const TeamState& state);
  Placed side_step(int robot, const TeamState& state, Placed best,
                   double latest = std::numeric_limits<double>::infinity());
  Placed detour(int robot, const TeamState& state, Placed best, int tries);
  Placed around_the_parked(int robot, const TeamState& state, bool goals);
  const std::optional<Path>& path_around(int robot, std::vector<std::vector<geom::Vec2>> parked);
  Placed among(int robot, const TeamState& state, Placed best, int patience);
  void overtake(TeamState& state);
  Placed around_the_resting(int robot, const TeamState& state, std::span<const Traffic> traffic);
  void add_bays(const std::vector<int>& group);
  void add_refuges(const std::vector<int>& group);
  std::vector<MakingWay::Other> others_of(int robot, const std::vector<int>& group) const;
  bool prove_hopeless(const std::vector<int>& group);
  bool rescue(TeamState& state, const TeamState& given, const Deadline& deadline);
  bool may_search() const;
  Placed place_somehow(int robot, const TeamState& state);
  void repair(TeamState& state, const Deadline& deadline);
  void shuffle(std::vector<int>& list, int from);
  bool keep(int robot, const std::shared_ptr<Way>& way, int most = 0);
  Placed place_along(int robot, const Path& path, const TeamState& state);
  std::shared_ptr<Way> keep_path(int robot, std::optional<Path> path);
  bool late(int robot, double arrival) const;
  WayPtr fastest_way(int robot) const;
  std::vector<int> group_around(int robot, const TeamState& state);
  bool replace_group(const std::vector<int>& group, TeamState& state, double limit);
  int pick_late(const TeamState& state);

  Coordinator& coordinator_;
  Sources sources_;
  TeamSearchOptions options_;
  Rng rng_;
  Precedence precedence_;
  CoordinatorWorkspace workspace_;
  Effort effort_;
  std::optional<std::pair<int, int>> hopeless_;
  struct Around {
    int robot;
    std::vector<std::vector<geom::Vec2>> parked;
    std::optional<Path> path;  // found around them
  };
  std::vector<Around> around_;
  std::vector<int> futile_;  // by robot: searches around the parked that found nothing
  int searches_ = 0;         // effort_.paths may not grow beyond
};

/// Σ arrival over the robots that have a motion, s.
double sum_of_arrivals(const TeamState& state);

}  // namespace seine::search
