#include "seine/search/formation_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"
#include "seine/search/cost_to_go.hpp"
#include "seine/search/point_distances.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

constexpr int kDirections = 8;
constexpr double kTurns[] = {0.0, 1.0, -1.0, 2.0, -2.0};         // of π / 2N
constexpr double kReach = 0.985;                                 // of the stretch limit
constexpr double kConvex = 0.12, kGround = 0.03, kApart = 0.06;  // m, kept on top of what is asked
constexpr double kNarrowest = 0.45, kStep = 0.0125;

Vec2 turned(Vec2 v, Vec2 by) {
  return {by.x * v.x - by.y * v.y, by.y * v.x + by.x * v.y};
}

class Shapes {
 public:
  Shapes(const world::Scenario& scenario, double heading, bool loaded)
      : scenario_(scenario), net_(*scenario.net), heading_(heading), loaded_(loaded) {
    Vec2 middle;
    for (const Vec2 r : net_.rest) middle += r / static_cast<double>(net_.size());
    // The ring as it stands, scaled to rest: turns are counted from there.
    std::vector<Vec2> ring;
    attachments_at(scenario, start_formation(scenario), formation_frame(scenario), ring);
    Vec2 center, turn;
    for (const Vec2 a : ring) center += a / static_cast<double>(ring.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 r = net_.rest[k] - middle, a = ring[k] - center;
      turn += Vec2{geom::dot(r, a), geom::cross(r, a)};
    }
    turn = turn / geom::norm(turn);
    for (const Vec2 r : net_.rest) rest_.push_back(turned(r - middle, turn));
  }

  std::vector<NarrowShape> all() {
    std::vector<NarrowShape> shapes;
    for (int i = 0; i < kDirections; ++i)
      for (const double t : kTurns) {
        const double along = std::numbers::pi * i / kDirections;
        const double turn = t * std::numbers::pi / (2.0 * static_cast<double>(net_.size()));
        if (auto shape = narrowest(along, turn)) shapes.push_back(std::move(*shape));
      }
    std::stable_sort(shapes.begin(), shapes.end(),
                     [](const NarrowShape& a, const NarrowShape& b) { return a.width < b.width; });
    return shapes;
  }

 private:
  std::optional<NarrowShape> narrowest(double along, double turn) {
    const Vec2 d = geom::unit(along), back{d.x, -d.y}, spin = geom::unit(turn);
    for (double across = kNarrowest; across < net_.stretch; across += kStep)
      for (double lengthwise = net_.stretch; lengthwise > 0.75; lengthwise -= kStep) {
        std::vector<Vec2> ring;
        for (const Vec2 r : rest_) {
          const Vec2 local = turned(turned(r, spin), back);
          ring.push_back(turned({lengthwise * local.x, across * local.y}, d));
        }
        if (safe(ring)) return shape_of(ring, along);
      }
    return std::nullopt;
  }

  bool safe(std::span<const Vec2> ring) const {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j)
        if (geom::norm(ring[i] - ring[j]) > kReach * net_.stretch * net::rest_distance(net_, i, j))
          return false;
      const Vec2 e = ring[(i + 1) % n] - ring[i];
      for (const std::size_t j : {(i + 2) % n, (i + n - 1) % n})
        if (geom::cross(e, ring[j] - ring[i]) < (net::kConvexMargin + kConvex) * geom::norm(e)) return false;
    }
    const double depth = loaded_ ? net::loaded_depth(net_, ring) : net::empty_depth(net_, ring);
    if (net_.rim() - depth < net_.clearance + kGround) return false;
    return apart(ring);
  }

  // The cars' footprints, all with one heading.
  bool apart(std::span<const Vec2> ring) const {
    std::vector<std::vector<Vec2>> cars;
    for (std::size_t k = 0; k < ring.size(); ++k) cars.push_back(car_at(ring, k));
    for (std::size_t i = 0; i < cars.size(); ++i)
      for (std::size_t j = i + 1; j < cars.size(); ++j)
        if (geom::distance_up_to(cars[i], cars[j], 1.0) < scenario_.margins.robot + kApart) return false;
    return true;
  }

  Vec2 axle(std::span<const Vec2> ring, std::size_t k) const {
    return ring[k] - turned(net_.attachments[k].at, geom::unit(heading_));
  }

  std::vector<Vec2> car_at(std::span<const Vec2> ring, std::size_t k) const {
    const vehicle::Model& model = scenario_.model_of(scenario_.robots[k]);
    std::vector<Vec2> footprint(model.footprint.size());
    const Vec2 at = axle(ring, k);
    geom::place(model.footprint, {at.x, at.y, heading_}, footprint);
    return footprint;
  }

  NarrowShape shape_of(std::span<const Vec2> ring, double along) const {
    NarrowShape shape;
    shape.along = along;
    const Vec2 across = geom::left_normal(geom::unit(along));
    double low = 0.0, high = 0.0;
    Vec2 mean;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      shape.formation.offsets.push_back(axle(ring, k));
      mean += shape.formation.offsets.back() / static_cast<double>(ring.size());
      for (const Vec2 corner : car_at(ring, k)) {
        low = std::min(low, geom::dot(corner, across));
        high = std::max(high, geom::dot(corner, across));
      }
    }
    for (Vec2& offset : shape.formation.offsets) offset -= mean;
    shape.width = high - low;
    return shape;
  }

  const world::Scenario& scenario_;
  const net::Net& net_;
  double heading_;
  bool loaded_;
  std::vector<Vec2> rest_;
};

}  // namespace

std::vector<NarrowShape> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded) {
  return Shapes(scenario, heading, loaded).all();
}

std::optional<Narrowest> narrowest_place(const FormationProblem& problem) {
  const world::Scenario& scenario = *problem.scenario;
  double size = 0.0, width = 0.0;
  for (const Vec2 r : scenario.net->rest) size = std::max(size, 2.0 * geom::norm(r));
  for (const world::Robot& robot : scenario.robots) width = std::max(width, scenario.model_of(robot).width());
  const double radius = 0.5 * width + scenario.margins.obstacle, cell = 0.5 * radius;
  const PointDistances distances(*problem.tall, cell, size);
  std::vector<Vec2> ring, places;
  attachments_at(scenario, problem.before, problem.start, ring);
  Vec2 at;
  for (const Vec2 a : ring) at += a / static_cast<double>(ring.size());
  for (const Rendezvous& meeting : problem.meetings) places.push_back(meeting.point);
  if (problem.goal) places.push_back(problem.goal->center);
  Narrowest result{0.0, std::numeric_limits<double>::infinity()};
  for (const Vec2 place : places) {
    CostToGo to_go({.distances = &distances, .radius = radius, .comfort = 0.5 * size, .discomfort = 10}, place);
    to_go.focus(at);
    double left = to_go(at);
    if (!std::isfinite(left)) return std::nullopt;
    // Downhill, a cell at a time.
    while (left > 2.0 * cell) {
      Vec2 best = at;
      for (int i = 0; i < 16; ++i) {
        const Vec2 next = at + 1.5 * cell * geom::unit(2.0 * std::numbers::pi * i / 16);
        const double value = to_go(next);
        if (value < left) left = value, best = next;
      }
      if (best == at) break;
      const double here = 2.0 * distances.bounds(best).lower;
      if (here < result.width) result = {std::atan2(best.y - at.y, best.x - at.x), here};
      at = best;
    }
    at = place;
  }
  return std::isfinite(result.width) ? std::optional(result) : std::nullopt;
}

}  // namespace seine::search
