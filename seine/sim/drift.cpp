#include "seine/sim/drift.hpp"

#include <cassert>
#include <cstddef>

namespace seine::sim {

using geom::Vec3;

Drift drift(std::span<const Vec3> before, std::span<const Vec3> now, double duration) {
  assert(before.size() == now.size() && !now.empty() && duration > 0.0);
  Drift drift;
  const double part = 1.0 / static_cast<double>(now.size());
  for (std::size_t k = 0; k < now.size(); ++k) {
    drift.middle += part * now[k];
    drift.velocity += (part / duration) * (now[k] - before[k]);
  }
  double turning = 0.0, size = 0.0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const geom::Vec2 arm = (now[k] - drift.middle).ground();
    const Vec3 velocity = (1.0 / duration) * (now[k] - before[k]) - drift.velocity;
    turning += geom::cross(arm, velocity.ground());
    size += geom::squared_norm(arm);
  }
  drift.yaw_rate = size > 0.0 ? turning / size : 0.0;
  return drift;
}

}  // namespace seine::sim
