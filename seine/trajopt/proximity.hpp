#pragma once

#include <span>
#include <vector>

#include "seine/geom/convex.hpp"
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
  struct Near {
    int a;
    int b;  ///< another car, or −1 − body
  };

  /// @param bodies must outlive this  @param extra cars × (cars + bodies): what repair rounds add to a
  /// clearance; may be empty
  Proximity(std::vector<Shape> shapes, std::vector<const Body*> bodies, std::vector<double> extra,
            double clearance, int ticks);

  /// Every kStride-th tick is a coarse one: who is near whom is judged there.
  static constexpr int kStride = 3;
  /// Finds who is near whom. @param states cars × ticks, of which the coarse ones are read  @param skin how
  /// far a pair may be apart beyond its clearance to be watched at coarse ticks; within `close` it is watched
  /// at every tick
  void rebuild(std::span<const ClockState> states, double skin, double close);
  /// Ticks at which a car is near anything, ascending.
  const std::vector<int>& ticks_of(int car) const { return needed_[static_cast<std::size_t>(car)]; }

  static constexpr int kChunks = 16;
  /// Cost of all distances in one chunk of ticks; writes ∂J/∂ of both cars into `states`.
  double evaluate(int chunk, std::span<ClockState> states, double weight, double knee) const;

 private:
  double one(const Near& near, int tick, std::span<ClockState> states, double weight, double knee) const;
  double clearance_of(int a, int b) const;
  double gap(const Near& near, int tick, std::span<const ClockState> states) const;
  void watch(const Near& near, int coarse, bool closely);

  std::vector<Shape> shapes_;
  std::vector<const Body*> bodies_;
  std::vector<double> extra_;
  double clearance_;
  int ticks_;
  std::vector<std::vector<Near>> near_;   // per tick
  std::vector<std::vector<int>> needed_;  // per car
};

}  // namespace seine::trajopt
