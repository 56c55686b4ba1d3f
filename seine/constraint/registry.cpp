#include "seine/constraint/registry.hpp"

#include <cmath>

#include "seine/constraint/corridor.hpp"
#include "seine/constraint/curvature.hpp"
#include "seine/constraint/footprint_distance.hpp"
#include "seine/constraint/inter_vehicle.hpp"
#include "seine/constraint/lateral_acceleration.hpp"
#include "seine/constraint/net_registry.hpp"
#include "seine/constraint/progress.hpp"
#include "seine/constraint/regularity.hpp"
#include "seine/constraint/speed.hpp"
#include "seine/constraint/steering_rate.hpp"
#include "seine/constraint/tangential_acceleration.hpp"

namespace seine::constraint {
namespace {

using geom::Vec2;

void draw_any(Rng& rng, std::span<double> x) {
  for (double& v : x) v = rng.uniform(-2.0, 2.0);
}

// First derivatives well away from zero, where a curve is regular.
void draw_curve(Rng& rng, std::span<double> x) {
  draw_any(rng, x);
  const double angle = rng.uniform(-3.0, 3.0), length = rng.uniform(0.5, 2.0);
  x[0] = length * std::cos(angle), x[1] = length * std::sin(angle);
}

// Two cars (position, direction each) a few lengths apart; directions need not be unit for the gradient to be
// right.
void draw_pair(Rng& rng, std::span<double> x) {
  for (std::size_t car = 0; car < x.size() / 4; ++car) {
    const double angle = rng.uniform(-3.0, 3.0);
    x[4 * car] = rng.uniform(-2.0, 2.0), x[4 * car + 1] = rng.uniform(-2.0, 2.0);
    x[4 * car + 2] = std::cos(angle), x[4 * car + 3] = std::sin(angle);
  }
}

math::Formula scalar(const char* name, double (*f)(double, double, double&)) {
  return {name, 1, [f](auto x, auto g) { return f(x[0], 1.7, g[0]); }, draw_any};
}

void put(std::span<double> out, std::initializer_list<Vec2> vectors) {
  std::size_t i = 0;
  for (const Vec2 v : vectors) out[i++] = v.x, out[i++] = v.y;
}

double corridor_entry(std::span<const double> x, std::span<double> g) {
  Vec2 g_p, g_d;
  const double value = corridor({x[0], x[1]}, {x[2], x[3]}, {0.5, -0.2}, {0.6, 0.8}, 0.3, g_p, g_d);
  put(g, {g_p, g_d});
  return value;
}

double curvature_entry(std::span<const double> x, std::span<double> g) {
  CurvatureGradient c;
  const double value = curvature(x[0], x[1], x[2], x[3], 1.3, c);
  put(g, {{c.d1x, c.d1y}, {c.d2x, c.d2y}});
  return value;
}

double steering_rate_entry(std::span<const double> x, std::span<double> g) {
  SteeringSample d;
  const double value = steering_rate({x[0], x[1], x[2], x[3], x[4], x[5], x[6]}, 0.4, 0.9, d);
  put(g, {{d.d1x, d.d1y}, {d.d2x, d.d2y}, {d.d3x, d.d3y}});
  g[6] = d.u1;
  return value;
}

double regularity_entry(std::span<const double> x, std::span<double> g) {
  RegularityGradient d;
  const double value = regularity(x[0], x[1], 1.4, d);
  put(g, {{d.d1x, d.d1y}});
  // The third input shifts l, to check that derivative too.
  RegularityGradient shifted;
  const double moved = regularity(x[0], x[1], 1.4 + 0.1 * x[2], shifted);
  put(g, {{d.d1x + shifted.d1x, d.d1y + shifted.d1y}});
  g[2] = 0.1 * shifted.length;
  return value + moved;
}

double inter_vehicle_entry(std::span<const double> x, std::span<double> g) {
  // The distance is of a rigid motion: only unit directions are meant, so the inputs are angles.
  const Vec2 da = geom::unit(x[2]), db = geom::unit(x[5]);
  PairGradient d;
  const double value =
      inter_vehicle({{x[0], x[1]}, da, 0.2, 0.5, 0.3}, {{x[3], x[4]}, db, -0.1, 0.7, 0.2}, d);
  put(g, {d.position_a});
  g[2] = geom::cross(da, d.direction_a);
  g[3] = d.position_b.x, g[4] = d.position_b.y;
  g[5] = geom::cross(db, d.direction_b);
  return value;
}

double footprint_distance_entry(std::span<const double> x, std::span<double> g) {
  static const std::vector<Vec2> footprint{{-0.2, -0.3}, {0.8, -0.2}, {1.0, 0.1}, {-0.1, 0.4}};
  static const std::vector<Vec2> body{{-0.5, -0.4}, {0.6, -0.3}, {0.1, 0.5}};
  // The distance is of a rigid motion: only unit directions are meant, so the inputs are angles.
  const Vec2 da = geom::unit(x[2]), db = geom::unit(x[5]);
  FootprintGradient d;
  const double value = footprint_distance({x[0], x[1]}, da, footprint, {x[3], x[4]}, db, body, d);
  put(g, {d.position_a});
  g[2] = geom::cross(da, d.direction_a);
  g[3] = d.position_b.x, g[4] = d.position_b.y;
  g[5] = geom::cross(db, d.direction_b);
  return value;
}

}  // namespace

std::vector<math::Formula> registry() {
  std::vector<math::Formula> all{{"corridor", 4, corridor_entry, draw_pair},
                                 {"curvature", 4, curvature_entry, draw_curve},
                                 {"footprint_distance", 6, footprint_distance_entry, draw_any},
                                 {"inter_vehicle", 6, inter_vehicle_entry, draw_any},
                                 scalar("lateral_acceleration", lateral_acceleration),
                                 scalar("progress", progress),
                                 {"regularity", 3, regularity_entry, draw_curve},
                                 scalar("speed", speed),
                                 {"steering_rate", 7, steering_rate_entry, draw_curve},
                                 scalar("tangential_acceleration", tangential_acceleration)};
  for (math::Formula& entry : net_registry()) all.push_back(std::move(entry));
  return all;
}

}  // namespace seine::constraint
