#include "seine/geom/convex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace seine::geom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Two vertices closer than this along a face normal (m) both count as supporting it: parallel edges after
// rounding.
constexpr double kTie = 1e-11;

std::size_t next_index(std::size_t i, std::size_t count) {
  return i + 1 == count ? 0 : i + 1;
}

// What the faces of `a` see of `b`: the largest over the faces of the signed distance of b beyond the face's
// line, and which faces b is wholly beyond.
struct Faces {
  double order = -kInfinity;  // gap·|gap| of the widest: ordered like the gap, without a root for each face
  std::size_t widest = 0;
  std::uint64_t facing = 0;  // bit i mod 64 for face i

  double gap() const { return order < 0.0 ? -std::sqrt(-order) : std::sqrt(order); }
};

template <std::size_t A, std::size_t B>
Faces look(std::span<const Vec2, A> a, std::span<const Vec2, B> b) {
  Faces faces;
  if (a.size() < 2) return faces;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 tail = a[i];
    const Vec2 along = a[i + 1 == a.size() ? 0 : i + 1] - tail;
    double side = -kInfinity;
    for (const Vec2 v : b) side = std::max(side, cross(along, v - tail));
    const double order = -side * std::abs(side) / squared_norm(along);
    if (order > faces.order) faces.order = order, faces.widest = i;
    faces.facing |= std::uint64_t{side <= 0.0} << (i & 63);
  }
  return faces;
}

// Rectangles are most of what is asked: loops of known length are twice as fast.
Faces look(std::span<const Vec2> a, std::span<const Vec2> b) {
  if (a.size() == 4 && b.size() == 4) return look(a.first<4>(), b.first<4>());
  if (a.size() == 4) return look(a.first<4>(), b);
  if (b.size() == 4) return look(a, b.first<4>());
  return look<std::dynamic_extent, std::dynamic_extent>(a, b);
}

struct Face {
  double gap = 0.0;
  std::size_t edge = 0;
  Vec2 normal;
};

Face widest_face(std::span<const Vec2> a, const Faces& seen) {
  const Vec2 along = a[next_index(seen.widest, a.size())] - a[seen.widest];
  return {seen.gap(), seen.widest, Vec2{along.y, -along.x} / norm(along)};
}

// Where the part of b that touches the face's supporting line lies over the edge of a: the middle of their
// overlap, as a point on the edge. `inside` tells whether there is one; only then is the gap of the face the
// Euclidean distance. (In an overlap there always is, but for rounding.)
struct Foot {
  bool inside = false;
  Vec2 on_edge;
};

Foot foot_on(std::span<const Vec2> a, std::span<const Vec2> b, const Face& face) {
  const Vec2 tail = a[face.edge];
  const Vec2 head = a[next_index(face.edge, a.size())];
  const Vec2 along{-face.normal.y, face.normal.x};
  const double length = dot(head - tail, along);
  double low = kInfinity;
  double high = -kInfinity;
  for (const Vec2 v : b) {
    if (dot(face.normal, v - tail) > face.gap + kTie) continue;
    const double t = dot(along, v - tail);
    low = std::min(low, t);
    high = std::max(high, t);
  }
  const double t = std::clamp(0.5 * (std::max(low, 0.0) + std::min(high, length)), 0.0, length);
  return {low <= length && high >= 0.0, tail + t * along};
}

struct Pair {
  double squared = kInfinity;
  Vec2 on_a;
  Vec2 on_b;
};

// The nearest pair of a point on an edge of `a` and a vertex of `b`, over the facing edges: when a and b are
// apart, the nearest pair has such an edge in one of the two.
void nearest_over_edges(std::span<const Vec2> a, std::span<const Vec2> b, std::uint64_t facing, bool swapped,
                        Pair& best) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((facing >> (i & 63) & 1U) == 0) continue;
    const Vec2 tail = a[i];
    const Vec2 along = a[next_index(i, a.size())] - tail;
    const double length2 = squared_norm(along);
    const double inverse = length2 > 0.0 ? 1.0 / length2 : 0.0;
    for (const Vec2 v : b) {
      const double t = std::clamp(dot(along, v - tail) * inverse, 0.0, 1.0);
      const Vec2 foot = tail + t * along;
      const double squared = squared_norm(v - foot);
      if (squared < best.squared) best = swapped ? Pair{squared, v, foot} : Pair{squared, foot, v};
    }
  }
}

Pair nearest_pair(std::span<const Vec2> a, const Faces& of_a, std::span<const Vec2> b, const Faces& of_b) {
  const bool flat = a.size() < 3 && b.size() < 3;  // without an inside, a gap of 0 has no facing side
  Pair best;
  nearest_over_edges(a, b, flat ? ~std::uint64_t{0} : of_a.facing, false, best);
  nearest_over_edges(b, a, flat ? ~std::uint64_t{0} : of_b.facing, true, best);
  return best;
}

// The same without the points: the least squared distance over the facing edges.
template <std::size_t B>
double least_squared(std::span<const Vec2> a, const Faces& of_a, std::span<const Vec2, B> b) {
  double least = kInfinity;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((of_a.facing >> (i & 63) & 1U) == 0) continue;
    const Vec2 tail = a[i];
    const Vec2 along = a[next_index(i, a.size())] - tail;
    const double inverse = 1.0 / squared_norm(along);
    for (const Vec2 v : b) {
      const double t = std::min(std::max(dot(along, v - tail) * inverse, 0.0), 1.0);
      least = std::min(least, squared_norm(v - tail - t * along));
    }
  }
  return least;
}
double least_squared(std::span<const Vec2> a, const Faces& of_a, std::span<const Vec2> b) {
  return b.size() == 4 ? least_squared(a, of_a, b.first<4>())
                       : least_squared<std::dynamic_extent>(a, of_a, b);
}

// Cores without an inside: points and segments. A segment's own direction must also be tried as a separating
// axis.
bool flat_and_apart(std::span<const Vec2> a, std::span<const Vec2> b) {
  if (a.size() > 2 || b.size() > 2) return false;
  if (a.size() == 1 || b.size() == 1) return true;  // a point has no depth in a segment
  const auto beyond = [](std::span<const Vec2> s, std::span<const Vec2> o) {
    const Vec2 along = s[1] - s[0];
    const double low = std::min(dot(along, o[0] - s[0]), dot(along, o[1] - s[0]));
    const double high = std::max(dot(along, o[0] - s[0]), dot(along, o[1] - s[0]));
    return low >= squared_norm(along) || high <= 0.0;
  };
  return beyond(a, b) || beyond(b, a);
}

Separation between(const Pair& pair, Vec2 fallback_normal) {
  const double d = std::sqrt(pair.squared);
  const Vec2 normal = d > 1e-12 ? (pair.on_b - pair.on_a) / d : fallback_normal;
  return {d, normal, pair.on_a, pair.on_b};
}

}  // namespace

void place(std::span<const Vec2> body, const Pose2& pose, std::span<Vec2> out) {
  const Vec2 d = pose.direction();
  for (std::size_t i = 0; i < body.size(); ++i) {
    out[i] = {pose.x + d.x * body[i].x - d.y * body[i].y, pose.y + d.y * body[i].x + d.x * body[i].y};
  }
}

Convex placed(const Convex& body, const Pose2& pose) {
  Convex result{std::vector<Vec2>(body.core.size()), body.radius};
  place(body.core, pose, result.core);
  return result;
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // Monotone chain [Andrew79]: the lower hull from left to right, then the upper one back.
  std::vector<Vec2> hull;
  const auto extend = [&hull](Vec2 p, std::size_t floor) {
    while (hull.size() > floor && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2 p : points) extend(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();
  return hull;
}

Separation separation(std::span<const Vec2> a, std::span<const Vec2> b) {
  const Faces of_a = look(a, b);
  const Faces of_b = look(b, a);
  const bool by_a = of_a.order >= of_b.order;
  if (a.size() == 1 && b.size() == 1) return between(nearest_pair(a, of_a, b, of_b), {1.0, 0.0});
  const Face face = by_a ? widest_face(a, of_a) : widest_face(b, of_b);
  const Vec2 normal = by_a ? face.normal : -face.normal;
  const bool flat = a.size() < 3 && b.size() < 3;
  if (flat && (face.gap >= -kTie || flat_and_apart(a, b)))
    return between(nearest_pair(a, of_a, b, of_b), normal);
  const Foot foot = by_a ? foot_on(a, b, face) : foot_on(b, a, face);
  if (!foot.inside && face.gap > 0.0) return between(nearest_pair(a, of_a, b, of_b), normal);
  const Vec2 opposite = foot.on_edge + face.gap * face.normal;
  return by_a ? Separation{face.gap, normal, foot.on_edge, opposite}
              : Separation{face.gap, normal, opposite, foot.on_edge};
}

Separation separation(const Convex& a, const Convex& b) {
  Separation result = separation(std::span<const Vec2>(a.core), std::span<const Vec2>(b.core));
  result.distance -= a.radius + b.radius;
  result.point_a += a.radius * result.normal;
  result.point_b -= b.radius * result.normal;
  return result;
}

double distance(std::span<const Vec2> a, std::span<const Vec2> b) {
  return distance_up_to(a, b, kInfinity);
}

double distance_up_to(std::span<const Vec2> a, std::span<const Vec2> b, double enough) {
  const double enough_order = enough * std::abs(enough);
  const Faces of_a = look(a, b);
  if (of_a.order >= enough_order && of_a.order > 0.0) return of_a.gap();
  const Faces of_b = look(b, a);
  const bool by_a = of_a.order >= of_b.order;
  const Faces& widest = by_a ? of_a : of_b;
  if (a.size() < 3 && b.size() < 3) {
    if (widest.gap() < -kTie && !flat_and_apart(a, b)) return widest.gap();
    return std::sqrt(nearest_pair(a, of_a, b, of_b).squared);
  }
  if (widest.order <= 0.0 || widest.order >= enough_order) return widest.gap();
  return std::sqrt(std::min(least_squared(a, of_a, b), least_squared(b, of_b, a)));
}

}  // namespace seine::geom
