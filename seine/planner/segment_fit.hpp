#pragma once

#include "seine/search/path.hpp"
#include "seine/trajopt/robot_task.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// How a guess is cut into polynomial pieces and how far its corridor looks.
struct FitOptions {
  double piece_length = 1.6;  ///< of the curve, car lengths …
  /// … or this times v_max²/a_max, where that is longer: where |p'| is uneven by a share δ along a piece, the
  /// car brakes and accelerates by about δ v²/piece; and the samples in time must see every piece.
  double piece_stopping = 0.46;
  double piece_turn = 0.8;  ///< rad of heading change that deserve a piece of their own
  double finer = 1.0;       ///< times as many pieces of the curve and of the progress
  /// Car lengths, or lengths of a path that is shorter than a car: shorter stretches in one gear are left
  /// out.
  double shortest_stretch = 0.05;
  double piece_duration = 0.6;    ///< of the progress, in t_a = v_max / a_max
  double shortest_wait = 0.6;     ///< a stop on the way at least this long, in t_a, becomes a rest of its own
  double corridor_reach = 1.0;    ///< car lengths
  double corridor_slack = 0.005;  ///< car lengths, on top of the certified margin
};

/// Turns a timed path into the optimiser's first guess for one car: one segment per gear and per long stop,
/// knots at equal arc length, progress at equal times, and the convex corridor around the path.
trajopt::RobotTask fit(const search::TimedPath& timed, const world::Scenario& scenario,
                       const world::Robot& robot, const world::StaticMap& map,
                       const FitOptions& options = {});

/// Whether the way is far too long for the pieces that a spline has (traj::UniformMinco::kMaxPieces): many
/// times a hundred metres in one gear.
bool too_long_to_fit(const search::TimedPath& guess, const vehicle::Model& model);

/// Rebuilds the corridor around a sequence of poses (curve samples, see RobotTask::corridor).
void set_corridor(trajopt::RobotTask& task, std::span<const geom::Pose2> poses,
                  const world::Scenario& scenario, const world::StaticMap& map, const FitOptions& options);

}  // namespace seine::planner
