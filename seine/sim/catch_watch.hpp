#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "seine/geom/vec3.hpp"
#include "seine/sim/net_physics.hpp"

namespace seine::sim {

/// What became of an object.
enum class Fate {
  flying,    ///< it has not fallen through the rim plane yet
  inside,    ///< it is in the net and still moves
  caught,    ///< it came to rest in the net in time
  restless,  ///< it stayed in the net but did not come to rest in time
  miss,      ///< it came down without touching the net
  side,      ///< it left between rim and ground
  out,       ///< it left above the rim
  bottom,    ///< it touched the ground in the net
  leak,      ///< it went through the net
};
const char* name_of(Fate fate);

inline constexpr double kRestSpeed = 0.3;  ///< m/s relative to the team: slower is at rest …
inline constexpr double kRestTime = 0.25;  ///< s, … when it lasts so long, in touch with the net
inline constexpr double kCatchTime = 2.5;  ///< s from the rim to rest

/// Watches one object and says what really happened to it, from what can be seen: places, never from the
/// engine's own opinion.
class CatchWatch {
 public:
  /// @param rim height of the corners, m
  /// @param fate `caught` for what lies in the net from the beginning
  CatchWatch(std::size_t ball, double rim, Fate fate = Fate::flying) : ball_(ball), rim_(rim), fate_(fate) {}

  /// To be called after every step of `physics`, at most some milliseconds apart.
  void look(double time, const NetPhysics& physics, std::span<const geom::Vec3> corners);

  Fate fate() const { return fate_; }
  bool lost() const { return fate_ >= Fate::miss; }
  double crossing_time() const { return crossing_; }   ///< s, when its centre fell through the rim plane
  double catch_time() const { return caught_; }        ///< s, when it had come to rest
  double lowest() const { return lowest_; }            ///< m above the ground, of its bottom, so far
  double highest_rebound() const { return rebound_; }  ///< m, of its centre after it first touched the net …
  /// At rest in the net now: in touch, slow, inside the corners' polygon, for kRestTime.
  bool at_rest() const { return rest_ >= kRestTime; }

 private:
  void judge(double time, const NetPhysics& physics, bool inside);
  bool pierced(const NetPhysics& physics) const;
  bool over_cloth(const NetPhysics& physics) const;
  void time_rest(double step, const NetPhysics& physics, std::span<const geom::Vec3> corners, bool inside);
  void remember(double time, const NetPhysics& physics, std::span<const geom::Vec3> corners);

  std::size_t ball_;
  double rim_;
  Fate fate_;
  bool touched_ = false, through_ = false;
  double crossing_ = 0.0, caught_ = 0.0, lowest_ = 1e9, rebound_ = -1e9;
  double rest_ = 0.0, untouched_ = 0.0;  // s
  bool started_ = false;
  double time_ = 0.0;
  geom::Vec3 place_;
  std::vector<geom::Vec3> nodes_, corners_;  // as last seen
};

}  // namespace seine::sim
