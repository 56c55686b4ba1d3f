#pragma once

#include <numbers>
#include <span>

#include "seine/geom/vec2.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/net.hpp"
#include "seine/net/target.hpp"

namespace seine::net {

// When a catch that is one in geometry is one in physics. The numbers come from over 12 000 drops into
// simulated nets of three, four and six corners, checked against a second engine (docs/net.md, "Why these
// limits"). All velocities are relative to the formation.

inline constexpr double kRimMargin =
    0.22;  ///< m, of the crossing point to every edge, beyond radius and error
inline constexpr double kContactMargin = 0.12;  ///< m, of where the flight meets the net's middle
inline constexpr double kLeastOpening =
    0.88;  ///< at the catch: less hangs so deep that fast objects touch ground
inline constexpr double kHeldOpening =
    0.86;                                  ///< afterwards, for kHoldTime: less lets them out over the edges
inline constexpr double kHoldTime = 1.0;   ///< s
inline constexpr double kMaxSpeed = 11.0;  ///< m/s: faster was measured with losses
inline constexpr double kMaxAngle = 0.25 * std::numbers::pi;  ///< rad from vertical
inline constexpr double kBraking = 3.0;  ///< m/s² after the catch: more was not measured
inline constexpr double kAirPush = 1.5;  ///< m/s²: what the air may push an object with while it is carried

/// The fastest object, m/s, that does not bounce over the rim of a net whose middle hangs `depth` (m) below
/// it: after one bounce it must turn 15 % short of √(2 g (D − r)). Rebound e as in Net.
double speed_limit(double depth, double radius, double rebound);
/// The other way round: how deep (m) the net must hang for an object at `speed`, up to kMaxSpeed.
double stopping_depth(double speed, double radius, double rebound);

/// How far below its hanging place (m) an object of `mass` (kg) at `speed` (m/s) carries the net: the
/// envelope of all drops.
double impact_drop(double speed, double mass);

/// How fast a team may carry an object of that drag (1/m), m/s: the air it is driven through pushes it
/// backwards by drag · speed², and no more than kAirPush of that is known to leave it in the net. Infinite
/// without drag.
double carry_speed(double drag);

/// What a catch comes to.
struct Catch {
  double time = 0.0;        ///< s, when the target's centre falls through the rim plane
  double rim_margin = 0.0;  ///< m: that point to the nearest edge, less radius and prediction error
  /// m: the same where the flight has fallen by `depth` in a straight line, and where a plumb line of that
  /// length then hangs as the formation accelerates and the air pushes: the smaller of both
  double contact_margin = 0.0;
  double opening = 0.0;  ///< of the net then
  double depth = 0.0;    ///< m: how far its middle hangs below the rim
  double angle = 0.0;    ///< rad, of the relative velocity from straight down
  double speed = 0.0;    ///< m/s, relative
  double bottom = 0.0;   ///< m above the ground: the deepest the net goes in the impact
};

/// How the middle of the attachments moves.
struct Motion {
  geom::Vec2 velocity;      ///< m/s
  geom::Vec2 acceleration;  ///< m/s²
};

/// Measures the catch of `target` as it falls through the rim plane (`crossing`), with the attachments where
/// they are then and moving as they do then.
Catch measure_catch(const Net& net, const Target& target, const Crossing& crossing,
                    std::span<const geom::Vec2> attachments, const Motion& formation);

}  // namespace seine::net
