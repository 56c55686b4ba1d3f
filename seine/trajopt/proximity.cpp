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

// Distance beyond the wanted clearance, roughly and from below.
double Proximity::gap(const Near& near, int tick, std::span<const ClockState> states) const {
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  const Shape& shape_a = shapes_[index(near.a)];
  const ClockState& a = states[index(near.a * ticks_ + tick)];
  const Vec2 middle_a = a.position + shape_a.offset * a.direction;
  if (near.b < 0) {
    const Body& body = bodies_[index(-1 - near.b)];
    const std::span<const Vec2> polygon(&body.polygons[index(tick) * index(body.vertices)], index(body.vertices));
    const geom::Box box = geom::bounding_box(polygon);
    const Vec2 low = box.low - middle_a, high = middle_a - box.high;
    const double outside = std::max({low.x, low.y, high.x, high.y});
    return outside - shape_a.reach - body.radius - body.clearance;
  }
  const Shape& shape_b = shapes_[index(near.b)];
  const ClockState& b = states[index(near.b * ticks_ + tick)];
  const double apart = geom::norm(b.position + shape_b.offset * b.direction - middle_a);
  return apart - shape_a.reach - shape_b.reach - clearance_of(near.a, near.b);
}

void Proximity::watch(const Near& near, int coarse, bool closely) {
  const int from = closely ? std::max(0, coarse - kStride / 2 + 1) : coarse;
  const int to = closely ? std::min(ticks_ - 1, coarse + kStride / 2) : coarse;
  for (int tick = from; tick <= to; ++tick) near_[static_cast<std::size_t>(tick)].push_back(near);
}

void Proximity::rebuild(std::span<const ClockState> states, double skin, double close) {
  for (auto& list : near_) list.clear();
  const auto cars = static_cast<int>(shapes_.size()), bodies = static_cast<int>(bodies_.size());
  for (int tick = 0; tick < ticks_; tick += kStride)
    for (int a = 0; a < cars; ++a) {
      const auto consider = [&](int b) {
        const double g = gap({a, b}, tick, states);
        if (g < skin) watch({a, b}, tick, g < close);
      };
      for (int b = a + 1; b < cars; ++b) consider(b);
      for (int k = 0; k < bodies; ++k) consider(-1 - k);
    }
  for (auto& list : needed_) list.clear();
  for (int tick = 0; tick < ticks_; ++tick)
    for (const Near& near : near_[static_cast<std::size_t>(tick)])
      for (const int car : {near.a, near.b}) {
        if (car < 0) continue;
        auto& list = needed_[static_cast<std::size_t>(car)];
        if (list.empty() || list.back() != tick) list.push_back(tick);
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
