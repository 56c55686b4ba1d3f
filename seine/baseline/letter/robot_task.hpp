#pragma once

#include <vector>

#include "seine/corridor/corridor.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::baseline::letter {

/// A stretch in one gear as the guess has it.
struct SegmentTask {
  int gear = 1;                    ///< η, fixed
  double piece_duration = 1.0;     ///< s
  std::vector<geom::Vec2> points;  ///< at the pieces' ends, m: one more than pieces
  double start_heading = 0.0, end_heading = 0.0;
  double start_speed = 0.24, end_speed = 0.24;  ///< m/s, unsigned, of the rests that cannot be rests

  int pieces() const { return static_cast<int>(points.size()) - 1; }
};

/// What the optimiser is given for one robot.
struct RobotTask {
  vehicle::Model model;
  geom::Pose2 start;
  std::vector<SegmentTask> segments;  ///< none: the car stands at its start
  bool free_cusps = true;             ///< gear-change poses are variables
  bool free_end = false;              ///< so is the final position
  corridor::Corridor corridor;        ///< a region for every sample of the quadrature, in order
};

}  // namespace seine::baseline::letter
