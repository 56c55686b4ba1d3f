#pragma once

#include <span>
#include <vector>

#include "seine/certify/gap.hpp"
#include "seine/certify/mover.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// A convex part of a moving obstacle.
struct MovingPart {
  int obstacle = 0;  ///< index into Scenario::obstacles
  Mover mover;
};

/// Everything that moves, cut into cells and slabs over one horizon.
struct Scene {
  double horizon = 0.0;  ///< s; afterwards everything rests
  int slabs = 0;
  std::vector<const Mover*> robots;  ///< null: could not be charted
  std::vector<MovingPart> moving;

  double slab_begin(int slab) const { return horizon * slab / slabs; }
};

/// What was found out about one robot.
struct Clearances {
  std::vector<Finding> findings;
  Closest robots;
  Closest obstacles;
};

/// An upper bound of the smallest distance between two robots, from a look at every slab: what is further
/// need not be resolved.
double glimpse(const Scene& scene);

/// Robot `robot` against the robots after it, the moving obstacles, the static map and the bounds.
Clearances prove_clearances(Context& context, const Scene& scene, int robot, double glimpsed);

}  // namespace seine::certify
