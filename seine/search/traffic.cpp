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

MovingBody::MovingBody(const geom::Convex& shape, std::span<const world::Waypoint> motion, double tick) {
  const std::vector<Vec2> polygon = enclosing_polygon(shape);
  const SweptFootprint footprint(polygon);
  corners_ = footprint.corners();
  boxes_ = footprint.is_box();
  const int rest = std::max(0, static_cast<int>(std::ceil(motion.back().t / tick + 0.5)));
  std::size_t next = 0;  // first waypoint later than the span of this tick
  for (int q = 0; q <= rest; ++q) {
    const geom::Pose2 pose = search::pose_at(motion, q * tick);
    double away = 0.0;
    const auto include = [&](const geom::Pose2& other) {
      away = std::max(away, norm(other.position() - pose.position()) +
                                footprint.reach() * std::abs(geom::wrap_angle(other.heading - pose.heading)));
    };
    include(search::pose_at(motion, (q - 0.5) * tick));
    include(search::pose_at(motion, (q + 0.5) * tick));
    while (next > 0 && motion[next - 1].t >= (q - 0.5) * tick) --next;
    for (; next < motion.size() && motion[next].t <= (q + 0.5) * tick; ++next)
      if (motion[next].t >= (q - 0.5) * tick) include(motion[next].pose);
    const std::span<Vec2> out = add_event(q, q == rest ? kForever : q + 1);
    events_.back().turned = footprint.grow(pose, away, out);
  }
  finish();
}

geom::Pose2 pose_at(std::span<const world::Waypoint> motion, double t) {
  const auto next = std::find_if(motion.begin(), motion.end(),
                                 [t](const world::Waypoint& waypoint) { return waypoint.t > t; });
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
    if (obstacle.motion.empty()) continue;
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
      parts.push_back({{{circle->center}, circle->radius}, obstacle.motion});
    } else {
      for (std::vector<Vec2>& part : geom::convex_parts(std::get<std::vector<Vec2>>(obstacle.shape)))
        parts.push_back({{std::move(part), 0.0}, obstacle.motion});
    }
  }
  return parts;
}

}  // namespace seine::search
