#pragma once

#include <cmath>
#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// S = √(mean_k |a_k − ā|²): how far apart the attachments are. With R the same of the net at rest, a payload
/// hangs D = √(R² − S²) below the rim: exactly in the middle of a regular net that is scaled as a whole, and
/// nearly where it is not; so limits on the depth (the payload must not drag; a catch wants the net neither
/// too flat nor too deep) are limits on S, which is smooth. The certificate has the exact depth.
/// @param gradient one entry an attachment
inline double net_spread(std::span<const geom::Vec2> attachments, std::span<geom::Vec2> gradient) {
  const double n = static_cast<double>(attachments.size());
  geom::Vec2 mean;
  for (const geom::Vec2 a : attachments) mean += a;
  mean *= 1.0 / n;
  double sum = 0.0;
  for (const geom::Vec2 a : attachments) sum += geom::squared_norm(a - mean);
  const double spread = std::sqrt(sum / n);
  // The mean itself moves too, but ∂/∂ā vanishes.
  for (std::size_t k = 0; k < attachments.size(); ++k) gradient[k] = (attachments[k] - mean) / (n * spread);
  return spread;
}

}  // namespace seine::constraint
