#include "seine/baseline/letter/registry.hpp"

#include <array>
#include <cmath>

#include "seine/baseline/letter/catch_cost.hpp"
#include "seine/baseline/letter/motion_limits.hpp"
#include "seine/baseline/letter/smooth_distance.hpp"
#include "seine/baseline/letter/time_map.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

void draw_any(Rng& rng, std::span<double> x) {
  for (double& v : x) v = rng.uniform(-2.0, 2.0);
}

// A velocity away from rest.
void draw_moving(Rng& rng, std::span<double> x) {
  draw_any(rng, x);
  const Vec2 v = rng.uniform(0.3, 2.5) * geom::unit(rng.uniform(-3.0, 3.0));
  x[0] = v.x, x[1] = v.y;
}

// A ring about the origin.
void draw_ring(Rng& rng, std::span<double> x) {
  const std::size_t count = x.size() / 2;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 6.283 * static_cast<double>(k) / static_cast<double>(count) + rng.uniform(-0.3, 0.3);
    const Vec2 corner = Vec2{rng.uniform(-0.6, 0.6), 0.3} + rng.uniform(0.7, 1.3) * geom::unit(angle);
    x[2 * k] = corner.x, x[2 * k + 1] = corner.y;
  }
}

math::Formula flat(const char* name, double (*f)(Vec2, Vec2, FlatGradient&)) {
  return {name, 4,
          [f](auto x, auto g) {
            FlatGradient d;
            const double value = f({x[0], x[1]}, {x[2], x[3]}, d);
            g[0] = d.velocity.x, g[1] = d.velocity.y, g[2] = d.acceleration.x, g[3] = d.acceleration.y;
            return value;
          },
          draw_moving};
}

double smooth_distance_entry(std::span<const double> x, std::span<double> g) {
  static const Shape kCar(std::vector<Vec2>{{-0.1, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {-0.1, 0.2}});
  static const Shape kWedge(
      std::vector<Vec2>{{-0.2, -0.3}, {0.8, -0.2}, {1.0, 0.1}, {-0.1, 0.4}, {-0.3, 0.1}});
  // The distance is of a rigid motion: only unit directions are meant, so the inputs are angles.
  const Stand a{{x[0], x[1]}, geom::unit(x[2])}, b{{x[3], x[4]}, geom::unit(x[5])};
  StandGradient d;
  const double value = smooth_distance(kCar, a, kWedge, b, 50.0, d);
  g[0] = d.position_a.x, g[1] = d.position_a.y, g[2] = geom::cross(a.direction, d.direction_a);
  g[3] = d.position_b.x, g[4] = d.position_b.y, g[5] = geom::cross(b.direction, d.direction_b);
  return value;
}

double edge_distance_entry(std::span<const double> x, std::span<double> g) {
  const EdgeDistance d = edge_distance({x[0], x[1]}, {x[2], x[3]}, {0.2, 0.1}, 0.2);
  g[0] = d.g_a.x, g[1] = d.g_a.y, g[2] = d.g_b.x, g[3] = d.g_b.y;
  return d.value;
}

double net_distance_entry(std::span<const double> x, std::span<double> g) {
  constexpr std::size_t kCount = 5;
  std::array<Vec2, kCount> ring, g_ring;
  for (std::size_t k = 0; k < kCount; ++k) ring[k] = {x[2 * k], x[2 * k + 1]};
  const double value = net_distance(ring, {0.3, -0.2}, 0.1, g_ring);
  for (std::size_t k = 0; k < kCount; ++k) g[2 * k] = g_ring[k].x, g[2 * k + 1] = g_ring[k].y;
  return value;
}

double catch_cost_entry(std::span<const double> x, std::span<double> g) {
  return catch_cost(x[0], {30.0, 100.0, 0.7}, g[0]);
}

double duration_entry(std::span<const double> x, std::span<double> g) {
  g[0] = duration_slope(x[0]);
  return duration_of(x[0]);
}

double clamped_entry(std::span<const double> x, std::span<double> g) {
  const double value = clamped(0.5 + 0.5 * x[0], 0.2, g[0]);
  g[0] *= 0.5;
  return value;
}

}  // namespace

std::vector<math::Formula> registry() {
  return {flat("speed_limit", [](Vec2 v, Vec2, FlatGradient& g) { return speed_limit(v, 1.7, g); }),
          flat("tangential_limit",
               [](Vec2 v, Vec2 a, FlatGradient& g) { return tangential_limit(v, a, 1.7, g); }),
          flat("lateral_limit", [](Vec2 v, Vec2 a, FlatGradient& g) { return lateral_limit(v, a, 1.7, g); }),
          flat("curvature_limit, left",
               [](Vec2 v, Vec2 a, FlatGradient& g) { return curvature_limit(v, a, 1.0, 1.3, g); }),
          flat("curvature_limit, right",
               [](Vec2 v, Vec2 a, FlatGradient& g) { return curvature_limit(v, a, -1.0, 1.3, g); }),
          {"smooth_distance", 6, smooth_distance_entry, draw_any},
          {"edge_distance", 4, edge_distance_entry, draw_any},
          {"net_distance", 10, net_distance_entry, draw_ring},
          {"catch_cost", 1, catch_cost_entry, draw_any},
          {"clamped", 1, clamped_entry, draw_any},
          {"duration", 1, duration_entry, draw_any}};
}

}  // namespace seine::baseline::letter
