#pragma once

#include <cstddef>
#include <span>

#include "seine/geom/vec3.hpp"
#include "seine/sim/net_mesh.hpp"

namespace seine::sim {

/// An object in the air, in the net or on the ground.
struct Ball {
  geom::Vec3 position, velocity;  ///< m, m/s, of its centre
  geom::Vec3 spin;                ///< rad/s
  double radius = 0.08;           ///< m
  double mass = 0.25;             ///< kg
  double drag = 0.0;              ///< 1/m: a = g − drag |v| v
};

/// A net, what falls into it, and the corners that robots move, as bodies. Engines stand behind this
/// interface so that one can check the other.
class NetPhysics {
 public:
  virtual ~NetPhysics() = default;

  /// Puts an object into the scene; returns its number, counted from 0.
  virtual std::size_t add(const Ball& ball) = 0;
  /// Lets `duration` (s) pass while the corners move evenly from where they are to `corners`.
  virtual void advance(std::span<const geom::Vec3> corners, double duration) = 0;

  virtual std::size_t balls() const = 0;
  virtual const Ball& ball(std::size_t index) const = 0;
  /// Whether the net held the object in the last step.
  virtual bool touching(std::size_t index) const = 0;
  virtual const NetMesh& mesh() const = 0;
  virtual std::span<const geom::Vec3> nodes() const = 0;  ///< m
  /// What the net pulls each corner with, N, mean over the last `advance`.
  virtual std::span<const geom::Vec3> pulls() const = 0;
};

}  // namespace seine::sim
