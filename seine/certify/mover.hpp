#pragma once

#include <span>
#include <vector>

#include "seine/certify/stretch.hpp"
#include "seine/geom/box.hpp"
#include "seine/geom/convex.hpp"
#include "seine/world/scenario.hpp"

namespace seine::certify {

/// A stretch of time in which a body frame goes straight and turns evenly; at rest both rates are zero.
struct Leg {
  double begin = 0.0;  ///< s, common clock
  Frame frame;         ///< at `begin`
  geom::Vec2 velocity;
  double heading = 0.0;
  double turn = 0.0;  ///< rad/s

  Frame at(double t) const;
};

/// An interval of the common clock in which a mover's motion is analytic: the unit of the proof.
struct Cell {
  double t0 = 0.0, t1 = 0.0;  ///< s
  double bend = 0.0;          ///< upper bound of the acceleration of any point of the body, m/s²
  geom::Box box;              ///< contains the body throughout
  int way = 0;                ///< index of the stretch, or of the leg as −1 − index
};

/// By how much a smooth function with |f''| ≤ bend can leave its chord over an interval of this width.
inline double chord_loss(double bend, double width) {
  return 0.125 * bend * width * width;
}

/// A rigid convex body with its motion from time 0 to a common horizon, after which it rests.
struct Mover {
  std::span<const geom::Vec2> core;  ///< body frame; the owner outlives the mover
  double radius = 0.0;               ///< m, around the core
  double reach = 0.0;                ///< largest distance of a core point from the body frame's origin, m
  std::vector<Stretch> stretches;
  std::vector<Leg> legs;
  std::vector<Cell> cells;  ///< in order of time, without gaps

  /// Hierarchy: per slab of the horizon the box of the body, and the first cell that reaches into it.
  std::vector<geom::Box> slab_box;
  std::vector<int> slab_cell;

  Frame frame(const Cell& cell, double t) const;
  /// Core points in the world at time t of a cell.
  void place(const Cell& cell, double t, std::span<geom::Vec2> out) const;
  /// Appends a cell; the body stands at `from` and `to` at its ends.
  void add_cell(double t0, double t1, double bend, int way, const Frame& from, const Frame& to);
  void add_rest(double t0, double t1, const Frame& frame);
  void build_slabs(int count, double horizon);
};

inline geom::Vec2 to_world(const Frame& frame, geom::Vec2 p) {
  return {frame.position.x + frame.forward.x * p.x - frame.forward.y * p.y,
          frame.position.y + frame.forward.y * p.x + frame.forward.x * p.y};
}

/// The convex parts of an obstacle's shape in its own frame.
std::vector<geom::Convex> parts_of(const world::Obstacle& obstacle);
/// A moving obstacle's part from time 0 to the horizon. @param grain cells are cut so that the body moves
/// about this far in one, m
Mover moving_part(const geom::Convex& part, std::span<const world::Waypoint> motion, double horizon,
                  double grain);

/// A lower bound of the signed distance of what two boxes contain: their distance, or minus their smaller
/// overlap.
double box_gap(const geom::Box& a, const geom::Box& b);

}  // namespace seine::certify
