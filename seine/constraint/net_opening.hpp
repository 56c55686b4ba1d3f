#pragma once

#include <cmath>
#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::constraint {

/// √(area of the polygon of attachments): with the same of the net at rest, how open the net is.
/// @param gradient one entry an attachment
inline double net_opening(std::span<const geom::Vec2> attachments, std::span<geom::Vec2> gradient) {
  const std::size_t n = attachments.size();
  double twice = 0.0;
  for (std::size_t k = 0; k < n; ++k) twice += geom::cross(attachments[k], attachments[(k + 1) % n]);
  // A polygon that is turned inside out has no root; there the slope is kept finite.
  const double root = std::sqrt(std::max(0.5 * twice, 1e-6));
  for (std::size_t k = 0; k < n; ++k) {
    const geom::Vec2 chord = attachments[(k + 1) % n] - attachments[(k + n - 1) % n];
    gradient[k] = geom::Vec2{chord.y, -chord.x} / (4.0 * root);
  }
  return root;
}

}  // namespace seine::constraint
