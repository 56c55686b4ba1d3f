#include "seine/certify/mover.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "seine/geom/polygon.hpp"

namespace seine::certify {

using geom::Box;
using geom::Vec2;

Frame Leg::at(double t) const {
  const double passed = t - begin;
  return {frame.position + passed * velocity,
          turn == 0.0 ? frame.forward : geom::unit(heading + passed * turn)};
}

Frame Mover::frame(const Cell& cell, double t) const {
  if (cell.way < 0) return legs[static_cast<std::size_t>(-1 - cell.way)].at(t);
  const Stretch& stretch = stretches[static_cast<std::size_t>(cell.way)];
  return stretch.frame(stretch.local(t));
}

void Mover::place(const Cell& cell, double t, std::span<Vec2> out) const {
  const Frame at = frame(cell, t);
  for (std::size_t i = 0; i < core.size(); ++i) out[i] = to_world(at, core[i]);
}

void Mover::add_cell(double t0, double t1, double bend, int way, const Frame& from, const Frame& to) {
  Box box;
  for (const Vec2 p : core) box.include(to_world(from, p)), box.include(to_world(to, p));
  cells.push_back({t0, t1, bend, box.inflated(radius + chord_loss(bend, t1 - t0)), way});
}

void Mover::add_rest(double t0, double t1, const Frame& frame) {
  legs.push_back({t0, frame, {}, 0.0, 0.0});
  add_cell(t0, t1, 0.0, -static_cast<int>(legs.size()), frame, frame);
}

void Mover::build_slabs(int count, double horizon) {
  slab_box.resize(static_cast<std::size_t>(count));
  slab_cell.resize(static_cast<std::size_t>(count));
  std::size_t first = 0;
  for (std::size_t s = 0; s < slab_box.size(); ++s) {
    const double t0 = horizon * static_cast<double>(s) / count,
                 t1 = horizon * static_cast<double>(s + 1) / count;
    while (first + 1 < cells.size() && cells[first].t1 < t0) ++first;
    slab_cell[s] = static_cast<int>(first);
    Box box;
    for (std::size_t i = first; i < cells.size() && (i == first || cells[i].t0 <= t1); ++i) {
      box.include(cells[i].box.low), box.include(cells[i].box.high);
    }
    slab_box[s] = box;
  }
}

std::vector<geom::Convex> parts_of(const world::Obstacle& obstacle) {
  if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape))
    return {{{circle->center}, circle->radius}};
  std::vector<geom::Convex> parts;
  for (auto& part : geom::convex_parts(std::get<std::vector<Vec2>>(obstacle.shape))) {
    parts.push_back({std::move(part), 0.0});
  }
  return parts;
}

namespace {

/// One straight way between two waypoints, or a rest, cut into cells.
void add_leg(Mover& mover, const Leg& leg, double t0, double t1, double grain) {
  mover.legs.push_back(leg);
  const int way = -static_cast<int>(mover.legs.size());
  const double bend = mover.reach * leg.turn * leg.turn;  // centripetal: the only acceleration there is
  const double way_length = (geom::norm(leg.velocity) + mover.reach * std::abs(leg.turn)) * (t1 - t0);
  const int count = static_cast<int>(std::clamp(std::ceil(way_length / grain), 1.0, 4096.0));
  for (int i = 0; i < count; ++i) {
    const double a = t0 + (t1 - t0) * i / count, b = i + 1 == count ? t1 : t0 + (t1 - t0) * (i + 1) / count;
    mover.add_cell(a, b, bend, way, leg.at(a), leg.at(b));
  }
}

}  // namespace

Mover moving_part(const geom::Convex& part, std::span<const world::Waypoint> motion, double horizon,
                  double grain) {
  Mover mover;
  mover.core = part.core;
  mover.radius = part.radius;
  for (const Vec2 p : part.core) mover.reach = std::max(mover.reach, geom::norm(p));
  const auto still = [](const world::Waypoint& at) { return Frame{at.pose.position(), at.pose.direction()}; };
  double t = 0.0;
  if (motion.front().t > 0.0) {
    t = std::min(motion.front().t, horizon);
    mover.add_rest(0.0, t, still(motion.front()));
  }
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    const world::Waypoint &from = motion[i], &to = motion[i + 1];
    if (to.t <= t || from.t >= horizon) continue;
    const double duration = to.t - from.t, end = std::min(to.t, horizon);
    const double turn = geom::wrap_angle(to.pose.heading - from.pose.heading) / duration;
    const Vec2 velocity = (to.pose.position() - from.pose.position()) / duration;
    add_leg(mover, {from.t, still(from), velocity, from.pose.heading, turn}, t, end, grain);
    t = end;
  }
  if (t < horizon || mover.cells.empty()) mover.add_rest(t, horizon, still(motion.back()));
  return mover;
}

double box_gap(const Box& a, const Box& b) {
  const double dx = std::max(a.low.x - b.high.x, b.low.x - a.high.x);
  const double dy = std::max(a.low.y - b.high.y, b.low.y - a.high.y);
  if (dx <= 0.0 || dy <= 0.0) return std::max(dx, dy);
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace seine::certify
