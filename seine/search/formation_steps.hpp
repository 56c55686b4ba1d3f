#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "seine/search/formation_ground.hpp"
#include "seine/vehicle/arc.hpp"

// What the search for a formation's way is made of; internal to formation_search.cpp.
namespace seine::search {

// Prices of a way: shares of a step's time, and of v / a.
inline constexpr double kCurvedPrice = 0.02, kBackwardPrice = 0.4;
inline constexpr double kSteeringPrice = 0.05, kGearPrice = 1.0;
inline constexpr double kLateralShare = 0.8;

/// Of the whole team: everybody drives the same way.
struct TeamLimits {
  double speed, reverse_speed, acceleration, lateral, curvature;
  double length;  ///< m, of the longest car

  /// s, at least, with what makes drivers avoid it.
  double time_of(const vehicle::Arc& arc) const {
    const double top = arc.distance > 0.0 ? speed : reverse_speed;
    const double bend = std::abs(arc.curvature);
    const double fastest = bend > 0.0 ? std::min(top, std::sqrt(kLateralShare * lateral / bend)) : top;
    const double dearer = (bend > 0.0 ? kCurvedPrice : 0.0) + (arc.distance < 0.0 ? kBackwardPrice : 0.0);
    return std::abs(arc.distance) / fastest * (1.0 + dearer);
  }
  /// s for going on with `next` after `before`; nothing at the start.
  double time_between(const vehicle::Arc* before, const vehicle::Arc& next) const {
    if (before == nullptr) return 0.0;
    const double unit = speed / acceleration;
    if (before->gear() != next.gear()) return kGearPrice * unit;
    return before->curvature == next.curvature ? 0.0 : kSteeringPrice * unit;
  }
};
TeamLimits limits_of(const world::Scenario& scenario);

inline constexpr int kChecks = 3;  ///< poses looked at in a step

/// A step of the lattice: where it leads, from where it begins, and how long it takes at best.
struct Move {
  vehicle::Arc arc;
  double time;
  std::array<Stand, kChecks> way;
};

/// A pose that has been reached.
struct Node {
  Stand stand;
  const Move* move;  ///< that led here
  double cost, estimate;
  double after;       ///< m driven since the last rendezvous was passed
  double s;           ///< m driven
  double held_since;  ///< m driven when the shape was complete
  double change;      ///< m over which it changed to that
  int parent;         ///< −1 at the root
  int phase;          ///< rendezvous passed
  int shape;          ///< held on the way here
  int shot = -1;      ///< the last part of the way, which ends in the goal; −1: a step
  bool closed = false;
};

/// What waits for its turn: a node, or a step from one that nobody has looked at yet.
struct Entry {
  double estimate;
  int node;                  ///< the step's parent where there is one
  std::int16_t move, shape;  ///< of the step; −1 for a node
};

/// Which node is the cheapest in a bin of poses. A search looks far more often than it adds, mostly in vain:
/// a table with open addressing has one cache miss for that.
class Bins {
 public:
  /// The bin's place for a node's index; −1 where there is none yet. Good until the next call.
  int& at(std::uint64_t bin) {
    if (3 * used_ >= 2 * slots_.size()) grow();
    Slot& slot = slot_of(bin);
    if (slot.node < 0) {
      used_ += slot.bin == kNone ? 1 : 0;
      slot.bin = bin;
    }
    return slot.node;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t bin = kNone;
    int node = -1;
  };

  Slot& slot_of(std::uint64_t bin) {
    std::size_t i = static_cast<std::size_t>(bin * 0x9e3779b97f4a7c15ULL >> shift_);
    while (slots_[i].bin != bin && slots_[i].bin != kNone) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    std::swap(old, slots_);
    --shift_;
    for (const Slot& slot : old)
      if (slot.bin != kNone) slot_of(slot.bin) = slot;
  }

  std::vector<Slot> slots_ = std::vector<Slot>(std::size_t{1} << 12);
  int shift_ = 64 - 12;
  std::size_t used_ = 0;
};

/// Lowest estimate first, in slices of a few milliseconds; in a slice whoever came last, for it is furthest
/// on.
class Waiting {
 public:
  explicit Waiting(double slice) : slice_(slice) {}

  void push(const Entry& entry) {
    const auto at = static_cast<std::size_t>(entry.estimate / slice_);
    if (at >= slices_.size()) slices_.resize(at + 1);
    slices_[at].push_back(entry);
    lowest_ = std::min(lowest_, at);
  }
  bool empty() {
    while (lowest_ < slices_.size() && slices_[lowest_].empty()) ++lowest_;
    return lowest_ >= slices_.size();
  }
  /// Needs !empty().
  Entry pop() {
    const Entry entry = slices_[lowest_].back();
    slices_[lowest_].pop_back();
    return entry;
  }
  /// Whether somebody's turn comes before that of an estimate.
  bool any_before(double estimate) {
    return !empty() && lowest_ < static_cast<std::size_t>(estimate / slice_);
  }

 private:
  double slice_;
  std::vector<std::vector<Entry>> slices_;
  std::size_t lowest_ = 0;
};

}  // namespace seine::search
