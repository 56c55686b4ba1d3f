#include "seine/search/swept_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "seine/geom/convex.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

// Distances are compared with this much tolerance, m: starts that touch exactly are legal at margin 0.
constexpr double kTouch = 1e-6;

std::size_t support(std::span<const Vec2> polygon, Vec2 direction) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    if (dot(polygon[i], direction) > dot(polygon[best], direction)) best = i;
  return best;
}

// The directions in which the outermost corner of the footprint or of the box changes, ascending, in [0, 2π).
std::vector<double> critical_angles(std::span<const Vec2> polygon) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<double> angles;
  for (int quarter = 0; quarter < 4; ++quarter) angles.push_back(0.25 * kTurn * quarter);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    double angle = std::atan2(-edge.x, edge.y);
    if (angle < 0.0) angle += kTurn;
    angles.push_back(angle);
  }
  std::sort(angles.begin(), angles.end());
  constexpr double kSame = 1e-9;
  angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < kSame; }),
               angles.end());
  if (angles.back() > kTurn - kSame) angles.pop_back();
  return angles;
}

enum class Sat { kApart, kNear, kOverlap };

// Looks for an edge of a that has all of b beyond it: by the clearance (kApart), or at all (kNear).
Sat separate(std::span<const Vec2> a, std::span<const Vec2> b, double clearance) {
  Sat result = Sat::kOverlap;
  const double clear = std::max(clearance - kTouch, 0.0);
  Vec2 from = a.back();
  for (const Vec2 to : a) {
    const Vec2 normal{to.y - from.y, from.x - to.x};
    const double length2 = squared_norm(normal);
    if (length2 < kTouch * kTouch) continue;  // corners fall together where a footprint is not grown
    double gap = dot(normal, b[0] - from);
    for (std::size_t i = 1; i < b.size(); ++i) gap = std::min(gap, dot(normal, b[i] - from));
    if (gap >= 0.0 && gap * gap >= clear * clear * length2) return Sat::kApart;
    if (gap < 0.0 && clear == 0.0 && gap * gap <= kTouch * kTouch * length2) return Sat::kApart;
    if (gap > 0.0) result = Sat::kNear;
    from = to;
  }
  return result;
}

}  // namespace

SweptFootprint::SweptFootprint(std::span<const Vec2> footprint) {
  const std::vector<double> angles = critical_angles(footprint);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * std::numbers::pi;
    const Vec2 direction = geom::unit(0.5 * (angles[i] + next));
    corners_.push_back({footprint[support(footprint, direction)], direction.x > 0.0, direction.y > 0.0});
  }
  box_ = geom::bounding_box(footprint);
  is_box_ = corners_.size() == 4 && footprint.size() == 4;
  for (const Vec2 p : footprint) {
    reach_ = std::max(reach_, norm(p));
    reach_x_ = std::max(reach_x_, std::abs(p.x));
    reach_y_ = std::max(reach_y_, std::abs(p.y));
  }
}

OrientedBox SweptFootprint::cover(const geom::Pose2& pose, const Slack& slack, std::span<Vec2> out) const {
  const double furthest = std::max(slack.ahead, slack.behind);
  const double turn = slack.curvature * furthest;
  const double second_order = 0.5 * turn * (turn * reach_ + furthest);
  const double front = slack.ahead * (1.0 + slack.curvature * reach_y_) + second_order;
  const double rear = slack.behind * (1.0 + slack.curvature * reach_y_) + second_order;
  return place(pose, front, rear, turn * reach_x_ + second_order, out);
}

OrientedBox SweptFootprint::place(const geom::Pose2& pose, double front, double rear, double side,
                                  std::span<Vec2> out) const {
  const Vec2 d = pose.direction();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corner& c = corners_[i];
    const Vec2 p{c.point.x + (c.front ? front : -rear), c.point.y + (c.left ? side : -side)};
    out[i] = {pose.x + d.x * p.x - d.y * p.y, pose.y + d.y * p.x + d.x * p.y};
  }
  const Vec2 low{box_.low.x - rear, box_.low.y - side}, high{box_.high.x + front, box_.high.y + side};
  const Vec2 middle = 0.5 * (low + high);
  return {{pose.x + d.x * middle.x - d.y * middle.y, pose.y + d.y * middle.x + d.x * middle.y},
          d,
          0.5 * (high.x - low.x),
          0.5 * (high.y - low.y)};
}

double squared_distance(const OrientedBox& a, const OrientedBox& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&least](const OrientedBox& box, const OrientedBox& other) {
    const Vec2 d = box.center - other.center, side = geom::left_normal(box.axis);
    // The box's centre and half sides in the other's frame.
    const Vec2 c{dot(d, other.axis), cross(other.axis, d)};
    const Vec2 u{box.half_length * dot(box.axis, other.axis), box.half_length * cross(other.axis, box.axis)};
    const Vec2 v{box.half_width * dot(side, other.axis), box.half_width * cross(other.axis, side)};
    for (const Vec2 corner : {c + u + v, c + u - v, c - u + v, c - u - v}) {
      const double x = std::max(std::abs(corner.x) - other.half_length, 0.0);
      const double y = std::max(std::abs(corner.y) - other.half_width, 0.0);
      least = std::min(least, x * x + y * y);
    }
  };
  look(a, b);
  look(b, a);
  return least;
}

bool apart(std::span<const Vec2> a, std::span<const Vec2> b, double clearance) {
  const Sat first = separate(a, b, clearance);
  if (first == Sat::kApart) return true;
  const Sat second = separate(b, a, clearance);
  if (second == Sat::kApart) return true;
  if (first == Sat::kOverlap && second == Sat::kOverlap) return false;
  return geom::distance(a, b) >=
         clearance - kTouch;  // corner against corner: no edge shows the true distance
}

}  // namespace seine::search
