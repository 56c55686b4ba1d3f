// Entries of the terms that a net brings.
#include "seine/constraint/net_registry.hpp"

#include "seine/constraint/catch_velocity.hpp"
#include "seine/constraint/delivery.hpp"
#include "seine/constraint/net_clearance.hpp"
#include "seine/constraint/net_edge.hpp"
#include "seine/constraint/net_hold.hpp"
#include "seine/constraint/net_opening.hpp"
#include "seine/constraint/net_radius.hpp"
#include "seine/constraint/net_spread.hpp"
#include "seine/constraint/net_stretch.hpp"
#include "seine/geom/pose2.hpp"

namespace seine::constraint {
namespace {

using geom::Vec2;

constexpr int kCorners = 4;

// A square about the origin, its corners moved a little: the order of the ring stays.
void draw_ring(Rng& rng, std::span<double> x) {
  for (double& v : x) v = rng.uniform(-2.5, 2.5);
  for (int k = 0; k < kCorners && 2 * static_cast<std::size_t>(k) + 1 < x.size(); ++k) {
    const Vec2 corner = 1.2 * geom::unit(0.5 * 3.14159265 * k);
    x[2 * static_cast<std::size_t>(k)] = corner.x + rng.uniform(-0.4, 0.4);
    x[2 * static_cast<std::size_t>(k) + 1] = corner.y + rng.uniform(-0.4, 0.4);
  }
}

void draw_any(Rng& rng, std::span<double> x) {
  for (double& v : x) v = rng.uniform(-2.0, 2.0);
}

Vec2 at(std::span<const double> x, std::size_t i) {
  return {x[2 * i], x[2 * i + 1]};
}

void put(std::span<double> g, std::size_t i, Vec2 v) {
  g[2 * i] = v.x, g[2 * i + 1] = v.y;
}

std::vector<Vec2> ring(std::span<const double> x) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < kCorners; ++k) points.push_back(at(x, k));
  return points;
}

template <class Pair>
math::Formula pair(const char* name, Pair term) {
  return {name, 4,
          [term](auto x, auto g) {
            Vec2 a, b;
            const double value = term(at(x, 0), at(x, 1), 1.3, a, b);
            put(g, 0, a), put(g, 1, b);
            return value;
          },
          draw_any};
}

template <class Ring>
math::Formula of_ring(const char* name, Ring term) {
  return {name, 2 * kCorners,
          [term](auto x, auto g) {
            std::vector<Vec2> gradient(kCorners);
            const double value = term(ring(x), gradient);
            for (std::size_t k = 0; k < kCorners; ++k) put(g, k, gradient[k]);
            return value;
          },
          draw_ring};
}

double edge_entry(std::span<const double> x, std::span<double> g) {
  EdgeGradient d;
  const double value = net_edge(at(x, 0), at(x, 1), at(x, 2), d);
  put(g, 0, d.a), put(g, 1, d.b), put(g, 2, d.p);
  return value;
}

double hold_entry(std::span<const double> x, std::span<double> g) {
  Vec2 i, j, k;
  const double value = net_hold(at(x, 0), at(x, 1), at(x, 2), 0.7, 0.3, i, j, k);
  put(g, 0, i), put(g, 1, j), put(g, 2, k);
  return value;
}

double clearance_of_ring(std::span<const Vec2> points, std::span<Vec2> gradient) {
  static const std::vector<Vec2> block{{1.4, 0.9}, {2.4, 1.0}, {1.7, 2.0}};
  return net_clearance(points, block, gradient);
}

double radius_of_ring(std::span<const Vec2> points, std::span<Vec2> gradient) {
  return net_radius(points, 1, gradient);
}

double velocity_entry(std::span<const double> x, std::span<double> g) {
  Vec2 p, q;
  const double value = catch_velocity(at(x, 0), at(x, 1), 0.4, {3.0, -1.0}, 0.5, p, q);
  put(g, 0, p), put(g, 1, q);
  return value;
}

double delivery_entry(std::span<const double> x, std::span<double> g) {
  Vec2 a, b;
  const double value =
      delivery(at(x, 0), {3.0, 1.0}, 0.5, a) + delivery_heading(at(x, 1), geom::unit(0.4), 0.1, b);
  put(g, 0, a), put(g, 1, b);
  return value;
}

}  // namespace

std::vector<math::Formula> net_registry() {
  return {{"catch_velocity", 4, velocity_entry, draw_any},
          {"delivery", 4, delivery_entry, draw_any},
          of_ring("net_clearance", clearance_of_ring),
          {"net_edge", 6, edge_entry, draw_ring},
          {"net_hold", 6, hold_entry, draw_ring},
          of_ring("net_opening", net_opening),
          of_ring("net_radius", radius_of_ring),
          of_ring("net_spread", net_spread),
          pair("net_stretch", net_stretch)};
}

}  // namespace seine::constraint
