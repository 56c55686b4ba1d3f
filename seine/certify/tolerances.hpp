#pragma once

namespace seine::certify {

/// What the proof grants to rounding, and to plans that were written down with few digits.
/// docs/certificate.md lists them.
namespace tolerance {
inline constexpr double kStartPosition = 1e-4;  // m, also of the goal
inline constexpr double kStartHeading = 1e-4;   // rad, also of the goal
inline constexpr double kSpeed = 1e-3;  // m/s: start speed, rest, jumps of the speed, motion against the gear
inline constexpr double kJunction = 1e-5;         // m, jump of the position
inline constexpr double kJunctionHeading = 1e-4;  // rad
inline constexpr double kLengthJump = 1e-3;       // of |p'| at a knot, relative
inline constexpr double kCurvatureJump = 1e-3;    // relative to κ_max
inline constexpr double kRange = 1e-6;            // u outside [0, pieces]

// Two thresholds each, so that every interval is decided at finite depth: what is seen beyond the first is a
// violation, what is proved to be within the second is kept.
inline constexpr double kLimitSeen = 5e-7, kLimitProved = 1e-6;             // relative
inline constexpr double kLimitSeenFloor = 5e-10, kLimitProvedFloor = 1e-9;  // absolute, units of the quantity
inline constexpr double kBackwardsSeen = 0.95e-3;              // m/s, against the gear; proved to kSpeed
inline constexpr double kGapSeen = 1.5e-4, kGapProved = 2e-4;  // m, below the margin
inline constexpr double kNetSeen = 5e-5, kNetProved = 1e-4;    // m, and of the opening of the net
}  // namespace tolerance

/// The closest approach is found to within this, m.
inline constexpr double kClosestResolution = 1e-3;
/// Obstacles further than this are not looked for, m.
inline constexpr double kObstacleSearch = 1.0;

/// When a car that starts inside the margin has first left it is looked at so often, s.
inline constexpr double kFreeStep = 1e-3;

/// What is left of the net's size and shape is found to within this, m.
inline constexpr double kNetResolution = 5e-3;
inline constexpr double kReserveResolution = 1e-2;  // m², of its holding reserve
/// What is left of its height, and of its distance to obstacles, m …
inline constexpr double kHeightResolution = 1e-2;
/// … of which those further than this from its polygon are not looked for, m.
inline constexpr double kNetSearch = 0.2;

}  // namespace seine::certify
