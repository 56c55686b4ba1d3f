#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/math/hinge.hpp"
#include "seine/trajopt/robot_problem.hpp"

namespace seine::trajopt {

/// A convex shape as the distance terms need it, in units.
struct Shape {
  std::vector<geom::Vec2> footprint;
  bool rectangle = false;  ///< symmetric about the x axis: the closed form serves
  double offset = 0.0, half_length = 0.0, half_width = 0.0;  ///< of the bounding rectangle
  double reach = 0.0;  ///< radius of the circle about the rectangle's middle
};
Shape shape_of(std::span<const geom::Vec2> footprint, double unit_length);

/// Where a body stands at one tick.
struct Placement {
  geom::Vec2 position, direction;  ///< direction is unit
};

/// A convex body whose motion is given: a moving obstacle, or a car that is not being planned. In units.
struct Body {
  Shape shape;
  double radius = 0.0;                ///< of its rounding
  double clearance = 0.0;             ///< to keep to it
  std::vector<Placement> placements;  ///< one a tick; stays at the last
};

/// Distances between cars, and between cars and bodies, at the ticks of the common clock; only where they are
/// near: at every tick where they are close, at every kStride-th where they might soon be. Partitioned by
/// ticks, so that threads never write to the same place and sums do not depend on their number.
class Proximity {
 public:
  /// @param bodies must outlive this  @param extra cars × (cars + bodies): what repair rounds add to a
  /// clearance; may be empty
  Proximity(std::vector<Shape> shapes, std::vector<const Body*> bodies, std::vector<double> extra,
            double clearance, int ticks);

  /// Every kStride-th tick is a coarse one: who is near whom is judged there.
  static constexpr int kStride = 3;
  /// Whether anything moves that is not a car of the problem.
  bool has_bodies() const { return !bodies_.empty(); }
  /// Finds who is near whom. @param states cars × ticks, of which the coarse ones are read  @param skin how
  /// far a pair may be apart beyond its clearance to be watched at coarse ticks; within `close` it is watched
  /// at every tick  @param until ticks from here on are not looked at
  void rebuild(std::span<const ClockState> states, double skin, double close, int until);
  /// Ticks at which a car is near anything, ascending.
  const std::vector<int>& ticks_of(int car) const { return needed_[static_cast<std::size_t>(car)]; }

  /// At most kChunks; by the problem, not by the threads.
  static constexpr int kChunks = 16;
  int chunks() const { return shapes_.size() == 1 ? 1 : kChunks; }
  /// Cost of all distances in one chunk of ticks; adds ∂J/∂ of both cars to `states`.
  double evaluate(int chunk, std::span<ClockState> states, double weight, double knee) const;

 private:
  /// Cars come first in all numberings, then the bodies.
  struct Near {
    int a;
    int b;
  };
  struct Outline {
    double offset, half_length, half_width;
    bool rectangle;
  };
  struct Penalty {
    double weight;
    math::Knee knee;
  };
  struct Pair;
  struct Batch;

  static double polygons(const Pair& pair, const Shape& shape_a, const Shape& shape_b, const Placement& b,
                         const Penalty& penalty);
  void watch(const Near& near, int coarse, bool closely);
  bool is_car(int index) const { return static_cast<std::size_t>(index) < shapes_.size(); }
  const Body& body(int index) const { return *bodies_[static_cast<std::size_t>(index) - shapes_.size()]; }
  const Shape& shape(int index) const {
    return is_car(index) ? shapes_[static_cast<std::size_t>(index)] : body(index).shape;
  }
  Placement placement(int index, int tick, std::span<const ClockState> states) const {
    if (!is_car(index)) {
      const auto& all = body(index).placements;
      return all[std::min(static_cast<std::size_t>(tick), all.size() - 1)];
    }
    const ClockState& state = states[static_cast<std::size_t>(index * ticks_ + tick)];
    return {state.position, state.direction};
  }

  std::vector<Shape> shapes_;
  std::vector<const Body*> bodies_;
  int ticks_;
  std::vector<Outline> outlines_;  // of cars and bodies
  std::vector<double> wanted_;     // cars × (cars + bodies): clearance, rounding included
  std::vector<double> reach_;      // likewise: middles further apart than this are clear in any attitude
  std::vector<std::vector<Near>> near_;   // per tick
  std::vector<std::vector<int>> needed_;  // per car
};

}  // namespace seine::trajopt
