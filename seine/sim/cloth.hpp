#pragma once

#include <array>
#include <vector>

#include "seine/geom/vec3.hpp"
#include "seine/sim/net_physics.hpp"

namespace seine::sim {

/// The nodes of a net within one step of position-based dynamics: where the step began, where it stands now.
struct Cloth {
  std::vector<geom::Vec3> position, before;  ///< m
  std::vector<geom::Vec3> velocity;          ///< m/s
  std::vector<double> inverse_mass;          ///< 1/kg; 0 for what is moved from outside
};

/// An object within one step.
struct Body {
  Ball ball;
  geom::Vec3 before;      ///< m, where the step began
  geom::Vec3 turn;        ///< rad, turned in this step
  bool touching = false;  ///< the net, in this step
};

/// The point of a triangle nearest to another point, as weights of its corners.
std::array<double, 3> nearest_weights(const std::array<geom::Vec3, 3>& triangle, geom::Vec3 point);

/// The faces of a cloth as something to bump into.
struct Surface {
  const std::vector<std::array<int, 3>>& faces;
  double face_reach;  ///< m, the farthest a corner of a face can be from its middle
  double friction;    ///< Coulomb's
};

/// Presses an object and the net apart where they overlap [Macklin16]. Faces are looked through in their
/// order, or from the last to the first.
void press_apart(Cloth& cloth, Body& body, const Surface& surface, bool backwards);
/// The same for two objects; frictionless. @param h s, of the step
void press_apart(Body& a, Body& b, double h);
/// Keeps an object above the ground, where it does not slide.
void keep_above_ground(Body& body);

}  // namespace seine::sim
