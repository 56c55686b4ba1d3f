#include "seine/constraint/footprint_distance.hpp"

#include <array>

namespace seine::constraint {
namespace {

using geom::Vec2;
constexpr std::size_t kMaxVertices = 64;

// Footprint in the world; the result points into `storage`.
std::span<const Vec2> place(Vec2 p, Vec2 d, std::span<const Vec2> body,
                            std::array<Vec2, kMaxVertices>& storage) {
  for (std::size_t i = 0; i < body.size(); ++i)
    storage[i] = {p.x + d.x * body[i].x - d.y * body[i].y, p.y + d.y * body[i].x + d.x * body[i].y};
  return {storage.data(), body.size()};
}

// ∂/∂d of n·(R(d) c) where R(d) c = witness − p.
Vec2 direction_gradient(Vec2 normal, Vec2 witness, Vec2 p, Vec2 d) {
  const Vec2 arm = witness - p;
  const Vec2 c{geom::dot(d, arm), geom::cross(d, arm)};  // the witness in the body frame
  return {c.x * normal.x + c.y * normal.y, c.x * normal.y - c.y * normal.x};
}

}  // namespace

double footprint_distance(Vec2 p_a, Vec2 d_a, std::span<const Vec2> footprint_a, Vec2 p_b, Vec2 d_b,
                          std::span<const Vec2> footprint_b, FootprintGradient& gradient) {
  std::array<Vec2, kMaxVertices> storage_a, storage_b;
  const geom::Separation s =
      geom::separation(place(p_a, d_a, footprint_a, storage_a), place(p_b, d_b, footprint_b, storage_b));
  gradient.position_a = -s.normal;
  gradient.direction_a = direction_gradient(-s.normal, s.point_a, p_a, d_a);
  gradient.position_b = s.normal;
  gradient.direction_b = direction_gradient(s.normal, s.point_b, p_b, d_b);
  return s.distance;
}

}  // namespace seine::constraint
