#include "seine/search/formation_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

constexpr int kDirections = 8;
constexpr double kTurns[] = {0.0, 1.0, -1.0, 2.0, -2.0};         // of π / 2N
constexpr double kReach = 0.985;                                 // of the stretch limit
constexpr double kConvex = 0.12, kGround = 0.03, kApart = 0.06;  // m, kept on top of what is asked
constexpr double kHolding = 0.3;                                 // m², of net::holding_reserve
constexpr double kNarrowest = 0.45, kStep = 0.02;

Vec2 turned(Vec2 v, Vec2 by) {
  return {by.x * v.x - by.y * v.y, by.y * v.x + by.x * v.y};
}

class Shapes {
 public:
  Shapes(const world::Scenario& scenario, double heading, bool loaded, double above)
      : scenario_(scenario), net_(*scenario.net), heading_(heading), loaded_(loaded), above_(above) {
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

  std::vector<Formation> all() {
    std::vector<Formation> shapes;
    for (int i = 0; i < kDirections; ++i) {
      const double along = std::numbers::pi * i / kDirections;
      std::optional<Shape> best;
      for (const double t : kTurns) {
        const double turn = t * std::numbers::pi / (2.0 * static_cast<double>(net_.size()));
        auto shape = narrowest(along, turn);
        if (shape && (!best || shape->width < best->width)) best = std::move(shape);
      }
      if (best) shapes.push_back(std::move(best->formation));
    }
    return shapes;
  }

 private:
  struct Shape {
    Formation formation;
    double width;  // m, of attachments and cars across its direction
  };

  std::optional<Shape> narrowest(double along, double turn) {
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
    if (loaded_ && net::holding_reserve(net_, ring) < kHolding) return false;
    if (net_.rim() - depth_of(ring) < above_ + kGround) return false;
    return apart(ring);
  }

  double depth_of(std::span<const Vec2> ring) const {
    return loaded_ ? net::loaded_depth(net_, ring) : net::empty_depth(net_, ring);
  }

  // The cars' footprints, all with one heading.
  bool apart(std::span<const Vec2> ring) const {
    const double wanted = scenario_.margins.robot + kApart;
    for (std::size_t i = 0; i < ring.size(); ++i)
      for (std::size_t j = i + 1; j < ring.size(); ++j) {
        if (geom::norm(axle(ring, i) - axle(ring, j)) >= reach_of(i) + reach_of(j) + wanted) continue;
        if (geom::distance_up_to(car_at(ring, i), car_at(ring, j), 1.0) < wanted) return false;
      }
    return true;
  }

  // Of a car's footprint from its rear axle.
  double reach_of(std::size_t k) const {
    double reach = 0.0;
    for (const Vec2 corner : scenario_.model_of(scenario_.robots[k]).footprint)
      reach = std::max(reach, geom::norm(corner));
    return reach;
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

  Shape shape_of(std::span<const Vec2> ring, double along) const {
    Shape shape{};
    shape.formation.along = geom::unit(along);
    shape.formation.lowest = net_.rim() - depth_of(ring);
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
  double above_;
  std::vector<Vec2> rest_;
};

}  // namespace

std::vector<Formation> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded,
                                     double above) {
  return Shapes(scenario, heading, loaded, above).all();
}

}  // namespace seine::search
