#include "seine/search/formation_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

constexpr std::size_t kDirections = 8;
constexpr double kTurns[] = {0.0, 1.0, -1.0, 2.0, -2.0};             // of π / 2N
constexpr double kReach = 0.985;                                     // of the stretch limit
constexpr double kConvex = 0.12, kGround = 0.03, kApart = 0.06;      // m, kept on top of what is asked
constexpr double kHolding = 0.3;                                     // m², of net::holding_reserve
constexpr double kCoarse = 3.0;                                      // short steps in a long one
constexpr double kNarrowest = 0.45, kShortest = 0.75, kStep = 0.02;  // scales of the net at rest

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

  std::vector<Formation> all(std::span<const double> above) const {
    std::vector<Formation> shapes;
    std::array<double, kDirections> lowest;
    lowest.fill(-std::numeric_limits<double>::infinity());
    for (const double height : above)
      for (std::size_t i = 0; i < kDirections; ++i) {
        if (lowest[i] >= height + kGround) continue;
        auto shape = narrowest(geom::unit(std::numbers::pi * static_cast<double>(i) / kDirections), height);
        if (!shape) continue;
        lowest[i] = shape->lowest;
        shapes.push_back(std::move(*shape));
      }
    return shapes;
  }

 private:
  // The net at rest in a turn of its own, along and across a direction, and how wide it is.
  struct Turned {
    std::vector<Vec2> local;
    double width;
  };

  std::vector<Turned> turns_for(Vec2 along) const {
    std::vector<Turned> all;
    for (const double t : kTurns) {
      const Vec2 spin = geom::unit(t * std::numbers::pi / (2.0 * static_cast<double>(net_.size())));
      Turned one;
      double low = 0.0, high = 0.0;
      for (const Vec2 r : rest_) {
        one.local.push_back(turned(turned(r, spin), {along.x, -along.y}));
        low = std::min(low, one.local.back().y), high = std::max(high, one.local.back().y);
      }
      one.width = high - low;
      all.push_back(std::move(one));
    }
    return all;
  }

  std::optional<Formation> narrowest(Vec2 along, double above) const {
    std::optional<Formation> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Turned& turn : turns_for(along)) {
      // A team is hardly ever narrower than its net.
      const double widest = std::min(net_.stretch, least / turn.width);
      auto shape = first_safe(turn, kNarrowest, widest, kCoarse * kStep, along, above);
      if (!shape) continue;
      const double width = width_of(*shape);
      if (width < least) best = std::move(shape), least = width;
    }
    return best;
  }

  // The narrowest between two scales across: in long steps first, then in short ones back from where it fits.
  std::optional<Formation> first_safe(const Turned& turn, double from, double to, double step, Vec2 along,
                                      double above) const {
    for (double across = from; across < to; across += step) {
      auto shape = squeezed(turn, across, along, above);
      if (!shape) continue;
      if (step > kStep && across > from)
        if (auto finer = first_safe(turn, across - step + kStep, across - 0.5 * kStep, kStep, along, above))
          return finer;
      return shape;
    }
    return std::nullopt;
  }

  // Of the cars across the shape's direction.
  double width_of(const Formation& shape) const {
    const Vec2 across = geom::left_normal(*shape.along), forward = geom::unit(heading_);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < shape.offsets.size(); ++k)
      for (const Vec2 corner : scenario_.model_of(scenario_.robots[k]).footprint) {
        const double at = geom::dot(shape.offsets[k] + turned(corner, forward), across);
        low = std::min(low, at), high = std::max(high, at);
      }
    return high - low;
  }

  // As long as the net allows; shorter only where a load would not stay in it, for a shorter net hangs lower
  // and has its cars closer.
  std::optional<Formation> squeezed(const Turned& turn, double across, Vec2 along, double above) const {
    std::vector<Vec2> ring(turn.local.size());
    for (double lengthwise = longest(turn, across); lengthwise > kShortest; lengthwise -= kStep) {
      for (std::size_t k = 0; k < ring.size(); ++k)
        ring[k] = turned({lengthwise * turn.local[k].x, across * turn.local[k].y}, along);
      if (!convex(ring)) continue;
      if (!apart(ring)) return std::nullopt;
      if (loaded_ && net::holding_reserve(net_, ring) < kHolding) continue;
      if (net_.rim() - depth_of(ring) < above + kGround) return std::nullopt;
      return formation_of(ring, along);
    }
    return std::nullopt;
  }

  // Scale along the direction at which the first pair is stretched as far as it may be.
  double longest(const Turned& turn, double across) const {
    double most = net_.stretch;
    for (std::size_t i = 0; i < turn.local.size(); ++i)
      for (std::size_t j = i + 1; j < turn.local.size(); ++j) {
        const Vec2 d = turn.local[i] - turn.local[j];
        const double limit = kReach * net_.stretch * net::rest_distance(net_, i, j), w = across * d.y;
        if (w > limit || -w > limit) return 0.0;
        if (std::abs(d.x) > 1e-9) most = std::min(most, std::sqrt(limit * limit - w * w) / std::abs(d.x));
      }
    return most;
  }

  bool convex(std::span<const Vec2> ring) const {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 e = ring[(i + 1) % n] - ring[i];
      for (const std::size_t j : {(i + 2) % n, (i + n - 1) % n})
        if (geom::cross(e, ring[j] - ring[i]) < (net::kConvexMargin + kConvex) * geom::norm(e)) return false;
    }
    return true;
  }

  double depth_of(std::span<const Vec2> ring) const { return net::loaded_depth(net_, ring); }

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

  Formation formation_of(std::span<const Vec2> ring, Vec2 along) const {
    Formation formation;
    formation.along = along;
    formation.lowest = net_.rim() - depth_of(ring);
    Vec2 mean;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      formation.offsets.push_back(axle(ring, k));
      mean += formation.offsets.back() / static_cast<double>(ring.size());
    }
    for (Vec2& offset : formation.offsets) offset -= mean;
    return formation;
  }

  const world::Scenario& scenario_;
  const net::Net& net_;
  double heading_;
  bool loaded_;
  std::vector<Vec2> rest_;
};

}  // namespace

std::vector<Formation> narrow_shapes(const world::Scenario& scenario, double heading, bool loaded,
                                     std::span<const double> above) {
  return Shapes(scenario, heading, loaded).all(above);
}

}  // namespace seine::search
