#pragma once

#include <vector>

#include "seine/search/formation.hpp"

namespace seine::search {

/// A shape for narrow places: the net turned and squeezed across the direction `along` as far as it may be.
struct NarrowShape {
  Formation formation;
  double along = 0.0;  ///< rad, the direction it is narrow across
  double width = 0.0;  ///< m, of attachments and cars across it
};

/// Shapes that keep the net safe (within its stretch, off the ground, convex) and the cars apart, one for
/// each direction of driving and turn of the ring, narrowest first. @param heading of the cars
std::vector<NarrowShape> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded);

/// The direction of the way around what is tall where it is narrowest, rad, and how wide it is there, m (a
/// lower bound, seen up to about twice the net's size).
struct Narrowest {
  double along = 0.0, width = 0.0;
};
std::optional<Narrowest> narrowest_place(const FormationProblem& problem);

}  // namespace seine::search
