#include "seine/sim/target_sensor.hpp"

#include <algorithm>

namespace seine::sim {

using geom::Vec3;

void TargetSensor::look(double time, Vec3 truth, Vec3 shift) {
  if (time < next_ - 1e-9) return;
  next_ = std::max(next_, time - noise_.sight_period) + noise_.sight_period;
  if (next_ <= time + 1e-9) next_ = time + noise_.sight_period;
  // All numbers are drawn whatever becomes of them: one sight never changes the next.
  const double dropout = rng_.uniform(), outlier = rng_.uniform();
  const auto normal = [this] {
    const double x = rng_.normal(), y = rng_.normal(), z = rng_.normal();
    return Vec3{x, y, z};
  };
  const Vec3 small = normal(), large = normal();
  if (dropout < noise_.dropouts) return;
  Vec3 seen = truth + shift + noise_.sight * small;
  if (outlier < noise_.outliers) seen += noise_.outlier_size * large;
  underway_.push_back({time, seen});
}

std::optional<Sighting> TargetSensor::delivered(double time) {
  if (underway_.empty() || underway_.front().time + noise_.sight_delay > time + 1e-9) return std::nullopt;
  const Sighting sighting = underway_.front();
  underway_.pop_front();
  return sighting;
}

}  // namespace seine::sim
