#pragma once

#include <cstddef>
#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// |a_k − ā|: how far one attachment is from the middle. A regular net with corners R from its middle hangs
/// at least √(R² − max_k |a_k − ā|²) below its rim, whatever its shape.
/// @param gradient one entry an attachment
inline double net_radius(std::span<const geom::Vec2> attachments, std::size_t k,
                         std::span<geom::Vec2> gradient) {
  const double n = static_cast<double>(attachments.size());
  geom::Vec2 mean;
  for (const geom::Vec2 a : attachments) mean += a;
  mean *= 1.0 / n;
  const geom::Vec2 d = attachments[k] - mean;
  const double radius = geom::norm(d);
  for (geom::Vec2& g : gradient) g = -(1.0 / (n * radius)) * d;
  gradient[k] += d / radius;
  return radius;
}

}  // namespace seine::constraint
