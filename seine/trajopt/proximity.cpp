#include "seine/trajopt/proximity.hpp"

#include <algorithm>
#include <cmath>

#include "seine/constraint/footprint_distance.hpp"
#include "seine/constraint/inter_vehicle.hpp"
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

Proximity::Proximity(std::vector<Shape> shapes, std::vector<const Body*> bodies, std::vector<double> extra,
                     double clearance, int ticks)
    : shapes_(std::move(shapes)),
      bodies_(std::move(bodies)),
      extra_(std::move(extra)),
      clearance_(clearance),
      ticks_(ticks),
      near_(static_cast<std::size_t>(ticks)),
      needed_(shapes_.size()) {}

double Proximity::clearance_of(int a, int b) const {
  const std::size_t cars = shapes_.size(),
                    column = b < 0 ? cars + static_cast<std::size_t>(-1 - b) : static_cast<std::size_t>(b);
  const double base = b < 0 ? bodies_[column - cars]->clearance : clearance_;
  return base +
         (extra_.empty() ? 0.0 : extra_[static_cast<std::size_t>(a) * (cars + bodies_.size()) + column]);
}

// Distance beyond the wanted clearance, roughly and from below.
double Proximity::gap(const Near& near, int tick, std::span<const ClockState> states) const {
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  const auto middle = [](const Shape& shape, Vec2 position, Vec2 direction) {
    return position + shape.offset * direction;
  };
  const Shape& shape_a = shapes_[index(near.a)];
  const ClockState& a = states[index(near.a * ticks_ + tick)];
  const Vec2 middle_a = middle(shape_a, a.position, a.direction);
  const double margin = shape_a.reach + clearance_of(near.a, near.b);
  if (near.b < 0) {
    const Body& body = *bodies_[index(-1 - near.b)];
    const Placement& at = body.placements[std::min(index(tick), body.placements.size() - 1)];
    return geom::norm(middle(body.shape, at.position, at.direction) - middle_a) - body.shape.reach -
           body.radius - margin;
  }
  const ClockState& b = states[index(near.b * ticks_ + tick)];
  const Shape& shape_b = shapes_[index(near.b)];
  return geom::norm(middle(shape_b, b.position, b.direction) - middle_a) - shape_b.reach - margin;
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
    for (const Near& near : near_[static_cast<std::size_t>(tick)])
      cost += one(near, tick, states, weight, knee);
  return cost;
}

double Proximity::one(const Near& near, int tick, std::span<ClockState> states, double weight,
                      double knee) const {
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  const bool given = near.b < 0;
  const Body* body = given ? bodies_[index(-1 - near.b)] : nullptr;
  const Shape& shape_a = shapes_[index(near.a)];
  const Shape& shape_b = given ? body->shape : shapes_[index(near.b)];
  ClockState& a = states[index(near.a * ticks_ + tick)];
  ClockState* b = given ? nullptr : &states[index(near.b * ticks_ + tick)];
  const Placement at = given ? body->placements[std::min(index(tick), body->placements.size() - 1)]
                             : Placement{b->position, b->direction};
  const double wanted = clearance_of(near.a, near.b) + (given ? body->radius : 0.0);
  const Vec2 apart =
      (at.position + shape_b.offset * at.direction) - (a.position + shape_a.offset * a.direction);
  const double reach = shape_a.reach + shape_b.reach + wanted;
  if (geom::squared_norm(apart) > reach * reach) return 0.0;

  constraint::PairGradient g;
  double gap;
  if (shape_a.rectangle && shape_b.rectangle) {
    gap = constraint::inter_vehicle(
        {a.position, a.direction, shape_a.offset, shape_a.half_length, shape_a.half_width},
        {at.position, at.direction, shape_b.offset, shape_b.half_length, shape_b.half_width}, g);
  } else {
    constraint::FootprintGradient f;
    gap = constraint::footprint_distance(a.position, a.direction, shape_a.footprint, at.position,
                                         at.direction, shape_b.footprint, f);
    g = {f.position_a, f.direction_a, f.position_b, f.direction_b};
  }
  if (gap >= wanted) return 0.0;
  double slope;
  const double cost = weight * math::hinge(wanted - gap, knee, slope);
  a.g_position -= weight * slope * g.position_a, a.g_direction -= weight * slope * g.direction_a;
  if (b != nullptr)
    b->g_position -= weight * slope * g.position_b, b->g_direction -= weight * slope * g.direction_b;
  return cost;
}

}  // namespace seine::trajopt
