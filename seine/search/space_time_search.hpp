#pragma once

#include <optional>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/search/swept_footprint.hpp"
#include "seine/search/traffic.hpp"

namespace seine::search {

/// How finely the space-time search looks. Lengths in metres.
struct SpaceTimeSettings {
  double step = 0.8;         ///< m driven per move
  double min_step = 0.4;     ///< m: a move that is blocked is tried at half its length, down to this
  double cell = 0.45;        ///< m, side of a position bin
  int headings = 24;         ///< heading bins
  int forward = 5;           ///< curvatures tried forwards (odd)
  int backward = 5;          ///< and backwards
  double speed_share = 0.7;  ///< of the grid's speeds: what the car is assumed to drive at
  double waiting = 0.2;      ///< what a second of waiting costs against one of driving, ≤ 1
  double heuristic_weight = 2.0;
  int max_expansions = 4000;
};

/// What a search works with.
struct SpaceTimeProblem {
  geom::Pose2 start;
  geom::Pose2 goal;
  const FootprintChecker* checker = nullptr;
  CostToGo* to_go = nullptr;  ///< of the disc around `reference`, to where that is at the goal
  geom::Vec2 reference;       ///< body frame
  const SweptFootprint* footprint = nullptr;
  const SpeedGrid* grid = nullptr;   ///< speeds; its half step is the clock of the traffic
  std::span<const Traffic> traffic;  ///< on that clock
  double radius = 1.0;               ///< m, of the tightest turn
  Deadline deadline;
};

struct SpaceTimeResult {
  std::optional<Route> route;
  double arrival = 0.0;  ///< s, by the search's own coarse timing, waits included
  int expansions = 0;
  bool goal_blocked = false;  ///< something stands on the goal for good
};

/// Hybrid A* [Dolgov10] over (pose, time) for one car among traffic: it may go around what moves, wait, leave
/// its place for something that passes and come back. Time is not cut into steps: as in safe interval path
/// planning [Phillips11] a node is a pose together with one of the spans in which nothing comes near it, kept
/// at its earliest arrival; how long to wait before a move follows from when the ground of the move is free.
/// The car drives at a share of its speed and loses v/(2a) wherever it starts or stops. Its route is meant
/// for an exact velocity plan. Deterministic; ties go to the node made first.
SpaceTimeResult search_space_time(const SpaceTimeProblem& problem, const SpaceTimeSettings& settings);

}  // namespace seine::search
