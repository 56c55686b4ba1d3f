#include "seine/search/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "seine/geom/convex.hpp"
#include "seine/geom/polygon.hpp"

namespace seine::search {
namespace {

constexpr double kFar = 100.0;  // radii of the car: a straight line this long is looked at as a whole
constexpr std::size_t kMaxCorners = 32;  // footprints with more fall back to the heap

/// Distance from a point inside a counter-clockwise convex polygon to its boundary (negative outside).
double depth_inside(std::span<const geom::Vec2> polygon, geom::Vec2 p) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const geom::Vec2 a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    depth = std::min(depth, geom::cross(edge, p - a) / geom::norm(edge));
  }
  return depth;
}

}  // namespace

DiscCover::DiscCover(std::span<const geom::Vec2> footprint) {
  const geom::Box box = geom::bounding_box(footprint);
  const geom::Vec2 size = box.size();
  axis = box.center().y;
  // Three discs cover a car of 3:2 within an eighth of its width; longer ones get more.
  const int count = std::max(1, static_cast<int>(std::ceil(2.0 * size.x / size.y - 1e-9)));
  const double slice = size.x / count;
  for (int i = 0; i < count; ++i) {
    const double x = box.low.x + (i + 0.5) * slice;
    const double inner = std::max(0.0, depth_inside(footprint, {x, axis}));
    discs.push_back({x, 0.5 * std::hypot(slice, size.y), inner});
  }
}

const DiscCover::Disc& DiscCover::widest() const {
  return *std::max_element(discs.begin(), discs.end(),
                           [](const Disc& a, const Disc& b) { return a.inner < b.inner - 1e-12; });
}

FootprintChecker::FootprintChecker(const world::StaticMap& map, const PointDistances* field,
                                   const vehicle::Model& model, double clearance)
    : map_(&map),
      field_(field),
      model_(&model),
      cover_(model.footprint),
      clearance_(clearance),
      resolution_(2e-4 * model.length()),
      look_(0.2 * model.length()) {
  const geom::Box box = geom::bounding_box(model.footprint);
  middle_ = box.center();
  reach_ = 0.5 * geom::norm(box.size());
}

void FootprintChecker::park(std::span<const geom::Vec2> footprint, double clearance) {
  const geom::Box box = geom::bounding_box(footprint);
  parked_.push_back({footprint, box.center(), 0.5 * geom::norm(box.size()), clearance});
}

void FootprintChecker::ease_slack(geom::Vec2 center, double radius, double slack) {
  eases_.push_back({center, radius * radius, slack});
}

double FootprintChecker::slack_at(geom::Vec2 position) const {
  double slack = slack_;
  for (const Ease& ease : eases_) {
    if (geom::squared_norm(position - ease.center) <= ease.radius_squared)
      slack = std::min(slack, ease.slack);
  }
  return slack;
}

double FootprintChecker::fastest_corner(double curvature) const {
  double square = 0.0;
  for (const geom::Vec2 p : model_->footprint) {
    const double along = 1.0 - curvature * p.y, across = curvature * p.x;
    square = std::max(square, along * along + across * across);
  }
  return std::sqrt(square);
}

double FootprintChecker::quick_room(const geom::Pose2& pose) const {
  if (field_ == nullptr) return 0.0;
  const geom::Vec2 ahead = pose.direction(), axis = pose.position() + cover_.axis * geom::left_normal(ahead);
  double room = std::numeric_limits<double>::infinity();
  for (const DiscCover::Disc& disc : cover_.discs) {
    const PointDistances::Bounds distance = field_->bounds(axis + disc.x * ahead);
    if (distance.upper < disc.inner + clearance_) return -1.0;
    room = std::min(room, distance.lower - disc.outer - clearance_);
  }
  return std::max(room, 0.0);
}

/// A lower bound of the room to the parked cars by bounding circles; `cap` when they are further off.
double FootprintChecker::parked_circles(const geom::Pose2& pose, double cap) const {
  double room = cap;
  const geom::Vec2 center = pose * middle_;
  for (const Parked& other : parked_) {
    const double apart = reach_ + other.radius + other.clearance;
    const double square = geom::squared_norm(center - other.center);
    if (square < (apart + room) * (apart + room)) room = std::sqrt(square) - apart;
    if (room <= slack_) return room;
  }
  return room;
}

double FootprintChecker::parked_room(const geom::Pose2& pose, std::span<const geom::Vec2> polygon,
                                     double cap) const {
  double room = cap;
  const geom::Vec2 center = pose * middle_;
  for (const Parked& other : parked_) {
    const double apart = reach_ + other.radius + other.clearance;
    const double square = geom::squared_norm(center - other.center);
    if (square >= (apart + room) * (apart + room)) continue;
    room = std::min(room, geom::distance(polygon, other.footprint) - other.clearance);
    if (room < 0.0) return room;
  }
  return room;
}

double FootprintChecker::room(const geom::Pose2& pose) const {
  const double quick = quick_room(pose);
  if (quick < 0.0) return quick;
  if (quick <= slack_) return near_room(pose, -1.0);
  const double circles = parked_circles(pose, quick);
  return circles > slack_ ? circles : near_room(pose, quick);
}

double FootprintChecker::exact_room(const geom::Pose2& pose) const {
  return near_room(pose, -1.0);
}

/// The room by the polygons themselves; that to the map is worked out when it is given as negative.
double FootprintChecker::near_room(const geom::Pose2& pose, double map_room) const {
  std::array<geom::Vec2, kMaxCorners> storage;
  std::vector<geom::Vec2> heap;
  std::span<geom::Vec2> polygon(storage.data(), std::min(kMaxCorners, model_->footprint.size()));
  if (model_->footprint.size() > kMaxCorners) {
    heap.resize(model_->footprint.size());
    polygon = heap;
  }
  geom::place(model_->footprint, pose, polygon);
  if (map_room < 0.0) map_room = map_->distance(polygon, clearance_ + look_) - clearance_;
  if (map_room < 0.0 || parked_.empty()) return map_room;
  return parked_room(pose, polygon, map_room);
}

double FootprintChecker::sweep(const geom::Pose2& from, double room_from, const vehicle::Arc& arc,
                               const geom::Pose2& to) const {
  const double room_to = room(to);
  if (room_to < slack_at(to.position())) return -1.0;
  const double length = std::abs(arc.distance), sign = arc.distance < 0.0 ? -1.0 : 1.0;
  const double speed = fastest_corner(arc.curvature);
  // Intervals still to prove, nearest last. A point at s keeps the room of either end less what the fastest
  // corner drives from there.
  struct Sample {
    double s, room;
  };
  std::array<Sample, 64> ahead;  // bisection: its depth is the logarithm of length over resolution
  std::size_t count = 0;
  Sample here{0.0, room_from};
  ahead[count++] = {length, room_to};
  while (count > 0) {
    const Sample next = ahead[count - 1];
    const double gap = next.s - here.s;
    const bool far = arc.curvature == 0.0 && gap > kFar * reach_;
    if (here.room + next.room >= speed * gap || gap <= resolution_ || count == ahead.size() ||
        (far && straight_clear(vehicle::drive(from, 0.0, sign * here.s), sign * gap))) {
      here = next;
      --count;
      continue;
    }
    const double s = here.s + 0.5 * gap;
    const geom::Pose2 pose = vehicle::drive(from, arc.curvature, sign * s);
    const double room_here = room(pose);
    if (room_here < slack_at(pose.position())) return -1.0;
    ahead[count++] = {s, room_here};
  }
  return room_to;
}

// Whether all of what a straight drive covers keeps clearance and slack, at one look.
bool FootprintChecker::straight_clear(const geom::Pose2& from, double distance) const {
  if (!parked_.empty()) return false;
  std::vector<geom::Vec2> covered;
  for (const geom::Pose2& pose : {from, vehicle::drive(from, 0.0, distance)})
    for (const geom::Vec2 corner : model_->footprint) covered.push_back(pose * corner);
  const double room = clearance_ + slack_;
  return map_->distance(geom::convex_hull(std::move(covered)), 1.1 * room + look_) > room;
}

double FootprintChecker::reach(const geom::Pose2& from, double room_from, const vehicle::Arc& arc) const {
  const double length = std::abs(arc.distance), sign = arc.distance < 0.0 ? -1.0 : 1.0;
  const double speed = fastest_corner(arc.curvature);
  double s = 0.0, room_here = room_from, slack = slack_at(from.position());
  while (s < length) {
    // As far as the room surely lasts, and a little further: contacts are approached in steps of a tenth.
    const double step = std::max(0.9 * (room_here - slack) / speed, resolution_);
    const double next = std::min(s + step, length);
    const geom::Pose2 pose = vehicle::drive(from, arc.curvature, sign * next);
    const double room_next = room(pose);
    slack = slack_at(pose.position());
    if (room_next < slack) return s;
    s = next, room_here = room_next;
  }
  return length;
}

bool FootprintChecker::clear(const geom::Pose2& from, const vehicle::Arc& arc) const {
  const double room_from = room(from);
  return room_from >= slack_at(from.position()) &&
         sweep(from, room_from, arc, vehicle::drive(from, arc)) >= 0.0;
}

Primitives Primitives::fan(double radius, double step, int forward, int backward) {
  Primitives fan;
  const auto add = [&](int count, double distance) {
    for (int i = 0; i < count; ++i) {
      const double turn = count > 1 ? 2.0 * i / (count - 1) - 1.0 : 0.0;
      fan.arcs.push_back({turn / radius, distance});
    }
  };
  add(forward, step);
  add(backward, -step);
  return fan;
}

}  // namespace seine::search
