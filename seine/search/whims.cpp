#include "seine/search/whims.hpp"

#include <algorithm>

#include "seine/base/rng.hpp"

namespace seine::search {

std::vector<Bump> whims(geom::Vec2 from, geom::Vec2 to, double length, std::uint64_t seed) {
  constexpr double kAside = 2.0, kRadius = 2.1;  // car lengths
  constexpr double kWeight = 2.5;                // what a metre in the middle of one costs
  Rng rng(seed);
  std::vector<Bump> bumps;
  const int count = 1 + rng.below(3);
  for (int i = 0; i < count; ++i) {
    const double along = rng.uniform(0.0, 1.0), x = rng.uniform(-1.0, 1.0), y = rng.uniform(-1.0, 1.0);
    const geom::Vec2 center = from + along * (to - from) + kAside * length * geom::Vec2{x, y};
    bumps.push_back({center, kRadius * length, kWeight});
  }
  return bumps;
}

bool changes_gear(const Path& path) {
  return std::any_of(path.points.begin(), path.points.end(),
                     [&](const PathPoint& point) { return point.gear != path.points.front().gear; });
}

}  // namespace seine::search
