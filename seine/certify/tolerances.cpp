#include "seine/certify/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace seine::certify {

Granted granted_to(const vehicle::Model& model) {
  const vehicle::Limits& limits = model.limits;
  const double size = std::min(1.0, model.length() / tolerance::kShortCar);
  double pace = std::min({1.0, limits.speed, std::sqrt(limits.acceleration * model.length())});
  if (limits.reverse_speed > 0.0) pace = std::min(pace, limits.reverse_speed);
  return {.size = size,
          .pace = pace,
          .start_position = tolerance::kStartPosition * size,
          .rest = std::max(tolerance::kRest * pace, tolerance::kLeastRest),
          .backwards = tolerance::kBackwards * size,
          .jump_position = tolerance::kJumpPosition * size,
          .jump_heading = tolerance::kJumpHeading,
          .jump_speed = std::max(tolerance::kJumpSpeed * pace, tolerance::kLeastRest),
          .jump_curvature = tolerance::kJumpCurvature * model.max_curvature()};
}

double smallest_size(const world::Scenario& scenario) {
  double size = 1.0;
  for (const world::Robot& robot : scenario.robots)
    size = std::min(size, granted_to(scenario.model_of(robot)).size);
  return size;
}

}  // namespace seine::certify
