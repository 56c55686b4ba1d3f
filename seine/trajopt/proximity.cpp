#include "seine/trajopt/proximity.hpp"

#include <algorithm>
#include <cmath>

#include "seine/constraint/inter_vehicle.hpp"
#include "seine/constraint/moving_obstacle.hpp"
#include "seine/math/hinge.hpp"

namespace seine::trajopt {

using geom::Vec2;

Shape shape_of(std::span<const Vec2> footprint, double unit_length) {
  Shape shape;
  for (const Vec2 corner : footprint) shape.footprint.push_back(corner / unit_length);
  const geom::Box box = geom::bounding_box(shape.footprint);
  shape.offset = box.center().x;
  shape.half_length = 0.5 * box.size().x, shape.half_width = 0.5 * box.size().y;
  const double tolerance = 1e-9 * box.size().x;
  shape.rectangle = footprint.size() == 4 && std::abs(box.center().y) < tolerance;
  for (const Vec2 corner : shape.footprint) {
    const bool at_corner = std::abs(std::abs(corner.x - shape.offset) - shape.half_length) < tolerance &&
                           std::abs(std::abs(corner.y) - shape.half_width) < tolerance;
    shape.rectangle = shape.rectangle && at_corner;
    shape.reach = std::max(shape.reach, geom::norm(corner - Vec2{shape.offset, 0.0}));
  }
  return shape;
}

Proximity::Proximity(std::vector<Shape> shapes, std::vector<Body> bodies, std::vector<double> pair_extra, double clearance,
                     int ticks)
    : shapes_(std::move(shapes)), bodies_(std::move(bodies)), pair_extra_(std::move(pair_extra)), clearance_(clearance),
      ticks_(ticks), near_(static_cast<std::size_t>(ticks)), needed_(shapes_.size()) {}

double Proximity::clearance_of(int a, int b) const {
  if (b < 0) return bodies_[static_cast<std::size_t>(-1 - b)].clearance;
  const std::size_t index = static_cast<std::size_t>(a) * shapes_.size() + static_cast<std::size_t>(b);
  return clearance_ + (pair_extra_.empty() ? 0.0 : pair_extra_[index]);
}

void Proximity::rebuild(std::span<const ClockState> states, double skin) {
  for (auto& list : needed_) list.clear();
  const auto cars = static_cast<int>(shapes_.size());
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  std::vector<Vec2> middle(shapes_.size());
  std::vector<char> needed(shapes_.size());
  for (int tick = 0; tick < ticks_; ++tick) {
    auto& list = near_[index(tick)];
    list.clear();
    std::fill(needed.begin(), needed.end(), 0);
    for (int a = 0; a < cars; ++a) {
      const ClockState& s = states[index(a * ticks_ + tick)];
      middle[index(a)] = s.position + shapes_[index(a)].offset * s.direction;
    }
    for (int a = 0; a < cars; ++a) {
      for (int b = a + 1; b < cars; ++b) {
        const double reach = shapes_[index(a)].reach + shapes_[index(b)].reach + clearance_of(a, b) + skin;
        if (geom::squared_norm(middle[index(a)] - middle[index(b)]) > reach * reach) continue;
        list.push_back({a, b});
        needed[index(a)] = needed[index(b)] = 1;
      }
      for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const Body& body = bodies_[k];
        const std::span<const Vec2> polygon(&body.polygons[index(tick) * index(body.vertices)], index(body.vertices));
        const geom::Box box = geom::bounding_box(polygon).inflated(body.radius + body.clearance + skin + shapes_[index(a)].reach);
        if (!box.contains(middle[index(a)])) continue;
        list.push_back({a, -1 - static_cast<int>(k)});
        needed[index(a)] = 1;
      }
    }
    for (int a = 0; a < cars; ++a)
      if (needed[index(a)]) needed_[index(a)].push_back(tick);
  }
}

double Proximity::evaluate(int chunk, std::span<ClockState> states, double weight, double knee) const {
  const int from = ticks_ * chunk / kChunks, to = ticks_ * (chunk + 1) / kChunks;
  double cost = 0.0;
  for (int tick = from; tick < to; ++tick)
    for (const Near& near : near_[static_cast<std::size_t>(tick)]) cost += one(near, tick, states, weight, knee);
  return cost;
}

double Proximity::one(const Near& near, int tick, std::span<ClockState> states, double weight, double knee) const {
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  const Shape& shape_a = shapes_[index(near.a)];
  ClockState& a = states[index(near.a * ticks_ + tick)];
  const double wanted = clearance_of(near.a, near.b);
  double slope;
  if (near.b < 0) {
    const Body& body = bodies_[index(-1 - near.b)];
    const std::span<const Vec2> polygon(&body.polygons[index(tick) * index(body.vertices)], index(body.vertices));
    Vec2 g_p, g_d;
    const double gap =
        constraint::moving_obstacle(a.position, a.direction, shape_a.footprint, polygon, body.radius, g_p, g_d);
    if (gap >= wanted) return 0.0;
    const double cost = weight * math::hinge(wanted - gap, knee, slope);
    a.g_position -= weight * slope * g_p;
    a.g_direction -= weight * slope * g_d;
    return cost;
  }
  const Shape& shape_b = shapes_[index(near.b)];
  ClockState& b = states[index(near.b * ticks_ + tick)];
  const Vec2 apart = (b.position + shape_b.offset * b.direction) - (a.position + shape_a.offset * a.direction);
  const double reach = shape_a.reach + shape_b.reach + wanted;
  if (geom::squared_norm(apart) > reach * reach) return 0.0;
  if (shape_a.rectangle && shape_b.rectangle) {
    constraint::PairGradient g;
    const double gap = constraint::inter_vehicle(
        {a.position, a.direction, shape_a.offset, shape_a.half_length, shape_a.half_width},
        {b.position, b.direction, shape_b.offset, shape_b.half_length, shape_b.half_width}, g);
    if (gap >= wanted) return 0.0;
    const double cost = weight * math::hinge(wanted - gap, knee, slope);
    a.g_position -= weight * slope * g.position_a, a.g_direction -= weight * slope * g.direction_a;
    b.g_position -= weight * slope * g.position_b, b.g_direction -= weight * slope * g.direction_b;
    return cost;
  }
  constraint::FootprintGradient g;
  const double gap = constraint::footprint_distance(a.position, a.direction, shape_a.footprint, b.position, b.direction,
                                                    shape_b.footprint, g);
  if (gap >= wanted) return 0.0;
  const double cost = weight * math::hinge(wanted - gap, knee, slope);
  a.g_position -= weight * slope * g.position_a, a.g_direction -= weight * slope * g.direction_a;
  b.g_position -= weight * slope * g.position_b, b.g_direction -= weight * slope * g.direction_b;
  return cost;
}

}  // namespace seine::trajopt
