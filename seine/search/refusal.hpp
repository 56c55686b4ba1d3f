#pragma once

#include <optional>
#include <span>
#include <string>

#include "seine/search/bottleneck.hpp"
#include "seine/world/scenario.hpp"

namespace seine::search {

/// Why a car has no way to its goal among what stands still.
struct Refusal {
  enum class Cause {
    start_closed_in,  ///< proved: not even the largest disc in the footprint gets away from the start …
    goal_closed_in,   ///< … or to the goal; what closes it in leaves some opening or none
    too_narrow,       ///< proved as well: the way is closed somewhere between
    no_room_found,    ///< a disc has a way, but no way was found for the whole car
    no_time,          ///< the deadline came first
  };
  Cause cause = Cause::no_room_found;
  std::optional<Bottleneck> place;  ///< the narrowest on the widest way; nothing where all is wide
  double width = 0.0;               ///< m, of the largest disc in the footprint
  double needed = 0.0;              ///< m, with the margin on both sides
  std::string beside;               ///< what stands nearest to that place: one thing, or two

  bool proved() const { return cause != Cause::no_room_found && cause != Cause::no_time; }
};

/// Looks for the cause once no way has been found; takes up to some 0.2 s in large worlds.
Refusal why_no_way(const world::Scenario& scenario, const world::StaticMap& map, int robot);

/// For a team that finds no passage with its net: where the widest way from the middle of its starts to the
/// delivery, or the middle of its goals, is narrowest, and how wide there; empty where it is wider than the
/// net, or there is no such end.
std::string narrowest_for_net(const world::Scenario& scenario, const world::StaticMap& map);

struct Verdict {
  std::string reason;
  bool proved = false;  ///< for one of them at least: no plan exists
};
/// The causes of several cars in one text, the first few in full.
/// @param late  the deadline has passed
Verdict why_no_ways(const world::Scenario& scenario, const world::StaticMap& map, std::span<const int> robots,
                    bool late);

/// For two cars of which cannot_both_arrive is proved.
std::string cannot_pass_sentence(const world::Scenario& scenario, int a, int b);

/// One sentence for people: what fails, where (in the user's coordinates), and what they could change.
std::string sentence(const Refusal& refusal, const world::Scenario& scenario, int robot);

}  // namespace seine::search
