#include "seine/trajopt/proximity.hpp"

#include <algorithm>
#include <array>
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
      ticks_(ticks),
      near_(static_cast<std::size_t>(ticks)),
      needed_(shapes_.size()) {
  const std::size_t columns = shapes_.size() + bodies_.size();
  for (std::size_t i = 0; i < columns; ++i) {
    const Shape& s = shape(static_cast<int>(i));
    outlines_.push_back({s.offset, s.half_length, s.half_width, s.rectangle});
  }
  for (std::size_t a = 0; a < shapes_.size(); ++a)
    for (std::size_t b = 0; b < columns; ++b) {
      const auto index = static_cast<int>(b);
      const double base = is_car(index) ? clearance : body(index).clearance + body(index).radius;
      wanted_.push_back(base + (extra.empty() ? 0.0 : extra[a * columns + b]));
      reach_.push_back(wanted_.back() + shapes_[a].reach + shape(index).reach);
    }
}

void Proximity::watch(const Near& near, int coarse, bool closely) {
  const int from = closely ? std::max(0, coarse - (kStride - 1) / 2) : coarse;
  const int to = closely ? std::min(ticks_ - 1, coarse + kStride / 2) : coarse;
  for (int tick = from; tick <= to; ++tick) near_[static_cast<std::size_t>(tick)].push_back(near);
}

void Proximity::rebuild(std::span<const ClockState> states, double skin, double close, int until) {
  for (auto& list : near_) list.clear();
  const std::size_t columns = outlines_.size();
  std::vector<Vec2> middles(columns);
  for (int tick = 0; tick < std::min(ticks_, until); tick += kStride) {
    for (std::size_t i = 0; i < columns; ++i) {
      const Placement at = placement(static_cast<int>(i), tick, states);
      middles[i] = at.position + outlines_[i].offset * at.direction;
    }
    for (std::size_t a = 0; a < shapes_.size(); ++a)
      for (std::size_t b = a + 1; b < columns; ++b) {
        const double squared = geom::squared_norm(middles[b] - middles[a]);
        const auto within = [&](double more) {
          const double reach = reach_[a * columns + b] + more;
          return squared < reach * reach;
        };
        if (within(skin)) watch({static_cast<int>(a), static_cast<int>(b)}, tick, within(close));
      }
  }
  for (auto& list : needed_) list.clear();
  for (int tick = 0; tick < ticks_; ++tick)
    for (const Near& near : near_[static_cast<std::size_t>(tick)])
      for (const int car : {near.a, near.b}) {
        if (!is_car(car)) continue;
        auto& list = needed_[static_cast<std::size_t>(car)];
        if (list.empty() || list.back() != tick) list.push_back(tick);
      }
}

// Two bodies within reach of each other at one tick.
struct Proximity::Pair {
  ClockState* a;
  ClockState* b;  // null: its motion is given
  double wanted;
};

// Pairs of rectangles, waiting for the vector code.
struct Proximity::Batch {
  constraint::PairLanes lanes;
  std::array<Pair, constraint::PairLanes::kLanes> pairs;
  std::size_t count = 0;

  void add(const Pair& pair, const constraint::OrientedBox& a, const constraint::OrientedBox& b) {
    constraint::put(a, b, lanes, count);
    pairs[count++] = pair;
  }
  double flush(const Penalty& penalty);
};

double Proximity::Batch::flush(const Penalty& penalty) {
  constraint::inter_vehicle(lanes, static_cast<int>(count));
  double cost = 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    const Pair& pair = pairs[j];
    if (lanes.gap[j] >= pair.wanted) continue;
    double slope;
    cost += penalty.weight * math::hinge(pair.wanted - lanes.gap[j], penalty.knee, slope);
    const double push = penalty.weight * slope;
    const Vec2 normal = push * Vec2{lanes.normal_x[j], lanes.normal_y[j]};
    pair.a->g_position += normal;
    pair.a->g_direction -= (push * lanes.turn_a[j]) * geom::left_normal(pair.a->direction);
    if (pair.b == nullptr) continue;
    pair.b->g_position -= normal;
    pair.b->g_direction -= (push * lanes.turn_b[j]) * geom::left_normal(pair.b->direction);
  }
  count = 0;
  return cost;
}

double Proximity::evaluate(int chunk, std::span<ClockState> states, double weight, double knee) const {
  const int from = ticks_ * chunk / chunks(), to = ticks_ * (chunk + 1) / chunks();
  const Penalty penalty{weight, math::Knee(knee)};
  Batch batch;
  double cost = 0.0;
  for (int tick = from; tick < to; ++tick)
    for (const Near& near : near_[static_cast<std::size_t>(tick)]) {
      const auto i = static_cast<std::size_t>(near.a), k = static_cast<std::size_t>(near.b);
      ClockState& a = states[i * static_cast<std::size_t>(ticks_) + static_cast<std::size_t>(tick)];
      const Outline &of_a = outlines_[i], &of_b = outlines_[k];
      const Placement b = placement(near.b, tick, states);
      const Vec2 apart = (b.position + of_b.offset * b.direction) - (a.position + of_a.offset * a.direction);
      const std::size_t entry = i * outlines_.size() + k;
      if (geom::squared_norm(apart) > reach_[entry] * reach_[entry]) continue;
      const Pair pair{&a,
                      is_car(near.b) ? &states[static_cast<std::size_t>(near.b * ticks_ + tick)] : nullptr,
                      wanted_[entry]};
      if (of_a.rectangle && of_b.rectangle)
        batch.add(pair, {a.position, a.direction, of_a.offset, of_a.half_length, of_a.half_width},
                  {b.position, b.direction, of_b.offset, of_b.half_length, of_b.half_width});
      else
        cost += polygons(pair, shape(near.a), shape(near.b), b, penalty);
      if (batch.count == batch.pairs.size()) cost += batch.flush(penalty);
    }
  return cost + batch.flush(penalty);
}

double Proximity::polygons(const Pair& pair, const Shape& shape_a, const Shape& shape_b, const Placement& b,
                           const Penalty& penalty) {
  constraint::FootprintGradient g;
  const double gap = constraint::footprint_distance(pair.a->position, pair.a->direction, shape_a.footprint,
                                                    b.position, b.direction, shape_b.footprint, g);
  if (gap >= pair.wanted) return 0.0;
  double slope;
  const double cost = penalty.weight * math::hinge(pair.wanted - gap, penalty.knee, slope);
  const double push = penalty.weight * slope;
  pair.a->g_position -= push * g.position_a, pair.a->g_direction -= push * g.direction_a;
  if (pair.b != nullptr)
    pair.b->g_position -= push * g.position_b, pair.b->g_direction -= push * g.direction_b;
  return cost;
}

}  // namespace seine::trajopt
