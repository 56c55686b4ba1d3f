#include "seine/search/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/geom/polygon.hpp"
#include "seine/search/path_cursor.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

constexpr int kChunkEvents = 8;

// Walks along a timed path with the clock: constant time a step.
class Walker {
 public:
  Walker(const Path& path, std::span<const ProfileKnot> profile)
      : path_(path), profile_(profile), cursor_(path) {}

  // Driven length at time t; t never decreases between calls.
  double driven(double t) {
    const std::span<const ProfileKnot> k = profile_;
    while (knot_ + 1 < k.size() && k[knot_ + 1].t <= t) ++knot_;
    if (knot_ + 1 >= k.size() || t <= k[knot_].t) return k[knot_].s;
    const double span = k[knot_ + 1].t - k[knot_].t, dt = t - k[knot_].t;
    return k[knot_].s + dt * (k[knot_].v + 0.5 * dt * (k[knot_ + 1].v - k[knot_].v) / span);
  }

  struct Place {
    geom::Pose2 pose;
    double curvature;  // largest |κ| between `from` and `to`
    bool one_gear;     // no cusp between them
    bool backwards;
  };
  Place place(double s, double from, double to) {
    const geom::Pose2 pose = cursor_.advance(s);
    const PathPoint& here = cursor_.point();
    Place place{pose, std::abs(here.curvature), true, here.gear < 0};
    const auto include = [&](const PathPoint& point) {
      place.curvature = std::max(place.curvature, std::abs(point.curvature));
      place.one_gear = place.one_gear && point.gear == here.gear;
    };
    const std::vector<PathPoint>& p = path_.points;
    for (std::size_t i = cursor_.index(); i > 0 && p[i].s >= from; --i) include(p[i - 1]);
    for (std::size_t i = cursor_.index(); i < p.size() && p[i].s <= to; ++i) include(p[i]);
    return place;
  }

 private:
  const Path& path_;
  std::span<const ProfileKnot> profile_;
  PathCursor cursor_;
  std::size_t knot_ = 0;
};

// A polygon that contains the rounded shape: its core's hull, or a regular one around a disc; grown as far as
// the radius asks.
std::vector<Vec2> enclosing_polygon(const geom::Convex& shape) {
  if (shape.radius <= 0.0 && shape.core.size() >= 3) return shape.core;
  constexpr int kSides = 16;
  const double radius = std::max(shape.radius, 1e-6) / std::cos(std::numbers::pi / kSides);
  std::vector<Vec2> points;
  for (const Vec2 core : shape.core)
    for (int i = 0; i < kSides; ++i)
      points.push_back(core + radius * geom::unit(2.0 * std::numbers::pi * i / kSides));
  return geom::convex_hull(std::move(points));
}

// What moves less than this within an event, in shares of its reach, need not have one for every tick.
constexpr double kStill = 1e-3;
// What moves further than this within one tick has several events for it.
constexpr double kLeap = 0.5;
// Beyond many events the tolerance doubles each time that this share of them has been added.
constexpr std::size_t kCoarserShare = 8;

// A moving obstacle between ticks: how far its points get from a pose in a span of time.
class ObstacleWalker {
 public:
  ObstacleWalker(std::span<const world::Waypoint> motion, double reach, double tick)
      : motion_(motion), reach_(reach), tick_(tick) {
    constexpr double kLast = 1 << 28;
    rest_ = static_cast<int>(std::clamp(std::ceil(motion.back().t / tick + 0.5), 0.0, kLast));
  }

  int rest() const { return rest_; }  // the tick from which on it stands
  geom::Pose2 middle(int q, int span) const {
    return search::pose_at(motion_, (q + 0.5 * (span - 1)) * tick_);
  }
  // Of any point of the body from its place at the middle of the ticks [q, q + span), m.
  double away(int q, int span) const {
    const double begin = (q - 0.5) * tick_, end = (q + span - 0.5) * tick_;
    const geom::Pose2 pose = middle(q, span);
    double most = std::max(between(pose, search::pose_at(motion_, begin)),
                           between(pose, search::pose_at(motion_, end)));
    for (auto w = first_after(begin); w != motion_.end() && w->t <= end; ++w)
      most = std::max(most, between(pose, w->pose));
    return most;
  }
  // Of any point from its last place, after the last tick.
  double away_for_good() const {
    double most = 0.0;
    for (auto w = first_after((rest_ - 0.5) * tick_); w != motion_.end(); ++w)
      most = std::max(most, between(motion_.back().pose, w->pose));
    return most;
  }
  // At most `most`: as long as it hardly moves.
  int longest_span(int q, int most, double tolerance) const {
    int span = std::min(most, rest_ - q);
    while (span > 1 && away(q, span) > tolerance) span /= 2;
    return std::max(span, 1);
  }
  struct Hop {
    geom::Pose2 pose;
    double away;
  };
  // One tick's motion in pieces in which no point gets further than `limit`.
  std::vector<Hop> hops(int q, double limit) const {
    constexpr double kMost = 1000.0;
    const double begin = (q - 0.5) * tick_, end = (q + 0.5) * tick_;
    std::vector<geom::Pose2> corners{search::pose_at(motion_, begin)};
    for (auto w = first_after(begin); w != motion_.end() && w->t < end; ++w) corners.push_back(w->pose);
    corners.push_back(search::pose_at(motion_, end));
    std::vector<Hop> hops;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const geom::Pose2 &a = corners[i], &b = corners[i + 1];
      const double way = between(a, b), turn = geom::wrap_angle(b.heading - a.heading);
      const int count = static_cast<int>(std::clamp(std::ceil(0.5 * way / limit), 1.0, kMost));
      for (int k = 0; k < count; ++k) {
        const double f = (k + 0.5) / count;
        hops.push_back(
            {{a.x + f * (b.x - a.x), a.y + f * (b.y - a.y), a.heading + f * turn}, 0.5 * way / count});
      }
    }
    return hops;
  }

 private:
  std::span<const world::Waypoint>::iterator first_after(double t) const {
    return std::lower_bound(motion_.begin(), motion_.end(), t,
                            [](const world::Waypoint& w, double at) { return w.t < at; });
  }
  double between(const geom::Pose2& a, const geom::Pose2& b) const {
    return norm(b.position() - a.position()) + reach_ * std::abs(geom::wrap_angle(b.heading - a.heading));
  }

  std::span<const world::Waypoint> motion_;
  double reach_, tick_;
  int rest_ = 0;
};

}  // namespace

std::span<Vec2> MovingBody::add_event(int begin, int end) {
  events_.push_back({{}, {}, begin, end});
  polygons_.resize(polygons_.size() + corners_);
  return {&polygons_[polygons_.size() - corners_], corners_};
}

void MovingBody::finish() {
  for (std::size_t e = 0; e < events_.size(); ++e) {
    Event& event = events_[e];
    event.box = geom::bounding_box(polygon(static_cast<int>(e)));
    if (e % kChunkEvents == 0) chunks_.push_back({{}, static_cast<int>(e), 0, event.begin, 0});
    Chunk& chunk = chunks_.back();
    chunk.last = static_cast<int>(e) + 1;
    chunk.end = event.end;
    for (geom::Box* box : {&chunk.box, &box_}) {
      box->include(event.box.low);
      box->include(event.box.high);
    }
  }
}

MovingBody::MovingBody(const Path& path, std::span<const ProfileKnot> profile,
                       const SweptFootprint& footprint, double tick)
    : corners_(footprint.corners()), boxes_(footprint.is_box()) {
  Walker walker(path, profile);
  const int rest = static_cast<int>(std::ceil(profile.back().t / tick + 0.5));
  events_.reserve(static_cast<std::size_t>(rest) + 1);
  polygons_.reserve((static_cast<std::size_t>(rest) + 1) * corners_);
  double before = walker.driven(0.0);
  bool was_still = false;
  for (int q = 0; q <= rest; ++q) {
    const double now = walker.driven(q * tick), after = walker.driven((q + 0.5) * tick);
    const bool still = before == after;
    if (still && was_still) {
      events_.back().end = q + 1;
    } else {
      const Walker::Place place = walker.place(now, before, after);
      Slack slack{after - now, now - before, place.curvature};
      if (!place.one_gear) slack.ahead = slack.behind = std::max(slack.ahead, slack.behind);
      if (place.backwards) std::swap(slack.ahead, slack.behind);
      const std::span<Vec2> out = add_event(q, q + 1);
      events_.back().turned = footprint.cover(place.pose, slack, out);
    }
    was_still = still;
    before = after;
  }
  events_.back().end = kForever;
  finish();
}

MovingBody::MovingBody(const geom::Convex& shape, std::span<const world::Waypoint> motion, double tick,
                       std::size_t many) {
  const std::vector<Vec2> polygon = enclosing_polygon(shape);
  const SweptFootprint footprint(polygon);
  corners_ = footprint.corners();
  boxes_ = footprint.is_box();
  const double reach = footprint.reach();
  const ObstacleWalker walker(motion, reach, tick);
  double tolerance = kStill * reach;
  std::size_t next = many;
  int span = 1;
  for (int q = 0; q < walker.rest(); q += span) {
    span = walker.longest_span(q, 2 * span, tolerance);
    if (span > 1 || walker.away(q, 1) <= kLeap * reach) {
      const std::span<Vec2> out = add_event(q, q + span);
      events_.back().turned = footprint.grow(walker.middle(q, span), walker.away(q, span), out);
    } else {
      for (const ObstacleWalker::Hop& hop : walker.hops(q, kLeap * reach)) {
        const std::span<Vec2> out = add_event(q, q + 1);
        events_.back().turned = footprint.grow(hop.pose, hop.away, out);
      }
    }
    if (events_.size() > next) next += std::max<std::size_t>(1, many / kCoarserShare), tolerance *= 2.0;
  }
  const std::span<Vec2> out = add_event(walker.rest(), kForever);
  events_.back().turned = footprint.grow(motion.back().pose, walker.away_for_good(), out);
  finish();
}

geom::Pose2 pose_at(std::span<const world::Waypoint> motion, double t) {
  const auto next =
      std::upper_bound(motion.begin(), motion.end(), t,
                       [](double at, const world::Waypoint& waypoint) { return at < waypoint.t; });
  if (next == motion.begin()) return motion.front().pose;
  const geom::Pose2& a = std::prev(next)->pose;
  if (next == motion.end()) return a;
  const double f = (t - std::prev(next)->t) / (next->t - std::prev(next)->t);
  const double turn = geom::wrap_angle(next->pose.heading - a.heading);
  return {a.x + f * (next->pose.x - a.x), a.y + f * (next->pose.y - a.y),
          geom::wrap_angle(a.heading + f * turn)};
}

std::vector<MovingPart> moving_parts(const world::Scenario& scenario) {
  std::vector<MovingPart> parts;
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    const int index = static_cast<int>(&obstacle - scenario.obstacles.data());
    if (world::stands_still(obstacle)) continue;
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
      parts.push_back({{{circle->center}, circle->radius}, obstacle.motion, index});
    } else {
      for (std::vector<Vec2>& part : geom::convex_parts(std::get<std::vector<Vec2>>(obstacle.shape)))
        parts.push_back({{std::move(part), 0.0}, obstacle.motion, index});
    }
  }
  return parts;
}

}  // namespace seine::search
