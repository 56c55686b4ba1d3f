#pragma once

#include <cmath>

#include "seine/geom/vec2.hpp"

namespace seine::baseline::letter {

/// ∂/∂σ̇ and ∂/∂σ̈.
struct FlatGradient {
  geom::Vec2 velocity, acceleration;
};

/// |σ̇|² − v_max² ≤ 0.
inline double speed_limit(geom::Vec2 v, double most, FlatGradient& gradient) {
  gradient = {2.0 * v, {}};
  return geom::squared_norm(v) - most * most;
}

/// a_t² − a_t,max² ≤ 0 with a_t = σ̇·σ̈ / |σ̇|.
inline double tangential_limit(geom::Vec2 v, geom::Vec2 a, double most, FlatGradient& gradient) {
  const double inverse = 1.0 / geom::norm(v), tangential = geom::dot(v, a) * inverse;
  const double twice = 2.0 * tangential * inverse;
  gradient = {twice * (a - (tangential * inverse) * v), twice * v};
  return tangential * tangential - most * most;
}

/// a_n² − a_n,max² ≤ 0 with a_n = σ̇×σ̈ / |σ̇|.
inline double lateral_limit(geom::Vec2 v, geom::Vec2 a, double most, FlatGradient& gradient) {
  const double inverse = 1.0 / geom::norm(v), lateral = geom::cross(v, a) * inverse;
  const double twice = 2.0 * lateral * inverse;
  gradient = {twice * (geom::Vec2{a.y, -a.x} - (lateral * inverse) * v), twice * geom::left_normal(v)};
  return lateral * lateral - most * most;
}

/// side·κ − κ_max ≤ 0 with κ = σ̇×σ̈ / |σ̇|³, once for each side ±1. Singular at rest.
inline double curvature_limit(geom::Vec2 v, geom::Vec2 a, double side, double most, FlatGradient& gradient) {
  const double inverse = 1.0 / geom::norm(v), inverse3 = inverse * inverse * inverse;
  const double curvature = geom::cross(v, a) * inverse3;
  gradient = {side * (inverse3 * geom::Vec2{a.y, -a.x} - (3.0 * curvature * inverse * inverse) * v),
              (side * inverse3) * geom::left_normal(v)};
  return side * curvature - most;
}

}  // namespace seine::baseline::letter
