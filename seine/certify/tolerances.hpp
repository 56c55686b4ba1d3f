#pragma once

#include "seine/vehicle/model.hpp"
#include "seine/world/scenario.hpp"

namespace seine::certify {

/// What the proof grants to rounding, and to plans that were written down with few digits. The table in
/// docs/certificate.md gives the reason of each. Lengths hold for cars from kShortCar on and shrink with
/// shorter ones; speeds are relative to a speed of the car (Granted).
namespace tolerance {
inline constexpr double kShortCar = 0.25;       // m
inline constexpr double kStartPosition = 1e-4;  // m, also of the goal
inline constexpr double kStartHeading = 1e-4;   // rad, also of the goal
inline constexpr double kRest = 1e-3;           // start speed, rest, motion against the gear, relative
inline constexpr double kLeastRest = 1e-9;      // m/s, whatever the car: rounding
inline constexpr double kBackwards = 1e-4;      // m against the gear, in all
// Jumps, each summed over all joints of one car's plan: what is granted once cannot add up.
inline constexpr double kJumpPosition = 1e-5;   // m
inline constexpr double kJumpHeading = 1e-4;    // rad
inline constexpr double kJumpSpeed = 1e-3;      // relative
inline constexpr double kJumpCurvature = 1e-3;  // of κ_max
inline constexpr double kRange = 1e-6;          // u outside [0, pieces]
// |p'| is nowhere below this, relative to its largest value on the curve piece, nor below so many metres.
inline constexpr double kLeastTangent = 1e-3, kLeastTangentFloor = 1e-6;

// Two thresholds each, so that every interval is decided at finite depth: what is seen beyond the first is a
// violation, what is proved to be within the second is kept.
inline constexpr double kLimitSeen = 5e-7, kLimitProved = 1e-6;             // relative
inline constexpr double kLimitSeenFloor = 5e-10, kLimitProvedFloor = 1e-9;  // of the car's own scale
inline constexpr double kBackwardsSeen = 0.95;                              // of what is granted
inline constexpr double kGapSeen = 1.5e-4, kGapProved = 2e-4;               // m, below the margin
inline constexpr double kNetSeen = 5e-5, kNetProved = 1e-4;  // m, and of the opening of the net
inline constexpr double kCatchSpeed = 1e-3;                  // m/s, relative to the net
}  // namespace tolerance

/// The tolerances of one car in its own units.
struct Granted {
  double size;            ///< of a length, in (0, 1]: its length over kShortCar, at most 1
  double pace;            ///< m/s, its unit of speed: least of 1 m/s, its speed limits, √(a_max · length)
  double start_position;  ///< m
  double rest;            ///< m/s
  double backwards;       ///< m, in all
  double jump_position;   ///< m, in all, as the next three
  double jump_heading;    ///< rad
  double jump_speed;      ///< m/s
  double jump_curvature;  ///< 1/m
};
Granted granted_to(const vehicle::Model& model);

/// The smallest Granted::size of a scenario's cars: clearances are granted by it.
double smallest_size(const world::Scenario& scenario);

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
