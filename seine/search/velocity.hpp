#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/search/traffic.hpp"

namespace seine::search {

/// Units [first, last] that are taken during ticks [begin, end).
struct Mark {
  int begin, end;  ///< end may be MovingBody::kForever
  int first, last;
};

/// The units whose polygon comes closer than `clearance` to the body, and when. `reach[q]` is the furthest
/// unit the car can be at by tick q (empty: anywhere): what lies beyond is left out.
std::vector<Mark> marks_of(const SpeedLattice& lattice, const MovingBody& body, double clearance,
                           std::span<const int> reach);

/// Which units of a lattice are taken at which tick, as bits.
class Occupied {
 public:
  void reset(const SpeedLattice& lattice, int ticks);
  void add(std::span<const Mark> marks);
  /// Spreads what stays for good over all later rows; call once after the last `add`.
  void finish();

  int ticks() const { return ticks_; }
  /// One row of `words` (plus one word of padding) for each tick.
  const std::uint64_t* row(int tick) const { return &bits_[static_cast<std::size_t>(tick) * stride_]; }

 private:
  int ticks_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint64_t> bits_;
  std::vector<Mark> lasting_;
};

/// Whether the car, in this group of units, keeps the clearance to the body during this event.
bool apart(const SpeedLattice& lattice, std::size_t group, const MovingBody& body, std::size_t event,
           double clearance);

/// The fastest way along a path among what is taken, or how far it got.
struct VelocityPlan {
  bool found = false;
  std::vector<ProfileKnot> profile;  ///< when found; consecutive knots of equal acceleration are merged
  double arrival = 0.0;              ///< s, when found
  std::vector<int>
      tested;  ///< when found: per tick, the unit the car is tested at, then at its goal for good
};

/// Where the states of one time step lie in VelocityWorkspace::layers, and which words of the way they are.
struct LayerWindow {
  std::size_t begin;
  int low, words;
};

/// Memory that is used again from call to call.
struct VelocityWorkspace {
  Occupied occupied;
  std::vector<std::uint64_t> layers;
  std::vector<LayerWindow> windows;
};

struct VelocityOptions {
  int ticks =
      0;  ///< horizon, half time steps; when the row of a later tick is asked for, the last one is used
  Deadline deadline{};  ///< nothing is found once it has passed
};

/// Exact dynamic programming over (way, speed, time): all states that can be reached at a time are one bitset
/// over the way for each speed level, and a time step is three shifts for each level. The car may wait
/// anywhere. Finds nothing where the states would take more than 256 MiB. Among the profiles of earliest
/// arrival the one that leaves last is taken: waiting is done at the start where possible.
VelocityPlan plan_velocity(const SpeedLattice& lattice, VelocityWorkspace& workspace,
                           const VelocityOptions& options);

}  // namespace seine::search
