#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "seine/base/rng.hpp"
#include "seine/geom/vec3.hpp"
#include "seine/sim/noise.hpp"

namespace seine::sim {

/// A position of an object as it was seen.
struct Sighting {
  double time = 0.0;  ///< s, when it was there
  geom::Vec3 position;
};

/// A camera that follows one object: now and then it sees nothing or something else, and it needs time.
class TargetSensor {
 public:
  TargetSensor(const Noise& noise, std::uint64_t seed) : noise_(noise), rng_(seed) {}

  /// To be called often, with what is true; takes a sight when one is due. `shift` is added to it, m.
  void look(double time, geom::Vec3 truth, geom::Vec3 shift = {});
  /// The next sight that has been delivered by `time`, oldest first.
  std::optional<Sighting> delivered(double time);

 private:
  Noise noise_;
  Rng rng_;
  double next_ = -1e300;  // s: at once
  std::deque<Sighting> underway_;
};

}  // namespace seine::sim
