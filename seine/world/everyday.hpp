#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "seine/vehicle/model.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world {

/// What a person tries in the first hour. All lengths scale with the vehicle: its length L, width W, smallest
/// turning radius R, and the way it needs to stop. Each kind has several variants; the seed chooses.
enum class Everyday {
  open,          ///< an empty field, a goal anywhere, with any heading
  near,          ///< a goal where the car stands, or 1e-12 m to a length away: ahead, behind, beside, turned
  forward_only,  ///< no reverse gear: a goal behind, beside, or a U-turn
  slalom,        ///< a row of pillars
  parallel,      ///< a kerbside slot of 1.4 L: in from ahead, from behind, after driving past; and out
  garage,        ///< a box with a few per cent of W to each side, nose first or backwards; and out
  door,     ///< a door 0.75 % of W and more wider than the car with its margins; one in eight is too narrow
  pocket,   ///< in a dead end with a square of 1.2 (R + L) + W in which to turn round
  lot,      ///< rows of bays, some taken: into a bay, or from one to another
  rolling,  ///< starts at speed: a near goal, a goal behind, a wall ahead
  moving,   ///< something crosses, comes towards, is slower, stands, or passes where the car stands
  pair,     ///< two cars: a lane with a bay, a door in turn, head-on, a queue
};

const char* name_of(Everyday kind);
std::optional<Everyday> everyday_named(std::string_view name);
/// All of them, in the order of the enumeration.
std::span<const Everyday> all_everyday();

/// The task of this kind for this vehicle that belongs to `seed`. Margins are 3 % of the vehicle's width.
/// Every task has a plan, but for the doors that are too narrow (`proved impossible` is their answer).
Scenario everyday(Everyday kind, const vehicle::Model& vehicle, std::uint64_t seed);

}  // namespace seine::world
