#pragma once

namespace seine::sim {

/// What a net is made of (docs/physics.md says how the numbers were found).
struct NetMaterial {
  double mass = 0.4;          ///< kg
  double stiffness = 1000.0;  ///< N: what would stretch a cord to twice its length
  double friction = 0.5;      ///< Coulomb's, of an object on the net
  double holding = 17.4;      ///< 1/s: how fast an object in the net loses speed relative to the team
  double air = 1.0;           ///< 1/s: the same for the net itself
  double step = 1e-3;         ///< s; shorter for objects smaller than 6 cm
};

/// The least rebound the model can have, and the largest.
inline constexpr double kLeastRebound = 0.214, kMostRebound = 0.804;

/// The material whose measured rebound is the one given (net::Net::rebound), within what the model can have.
NetMaterial material_of_rebound(double rebound);

}  // namespace seine::sim
