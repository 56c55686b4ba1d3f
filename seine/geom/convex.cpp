#include "seine/geom/convex.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace seine::geom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Two vertices closer than this along a face normal (m) both count as supporting it: parallel edges after rounding.
constexpr double kTie = 1e-11;

std::size_t next_index(std::size_t i, std::size_t count) { return i + 1 == count ? 0 : i + 1; }

// The face of `a` that sees the smallest overlap with `b`: the largest over a's faces of the signed distance of b beyond it.
struct Face {
  double gap = -kInfinity;
  std::size_t edge = 0;
  Vec2 normal;
};

Face widest_face(std::span<const Vec2> a, std::span<const Vec2> b) {
  Face best;
  if (a.size() < 2) return best;
  Vec2 tail = a.back();
  std::size_t edge = a.size() - 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 along = a[i] - tail;
    const Vec2 outward{along.y, -along.x};
    double least = kInfinity;
    for (const Vec2 v : b) least = std::min(least, dot(outward, v));
    const double length = norm(along);
    const double gap = (least - dot(outward, tail)) / length;
    if (gap > best.gap) best = {gap, edge, outward / length};
    tail = a[i];
    edge = i;
  }
  return best;
}

// Where the part of b that touches the face's supporting line lies over the edge of a: the middle of their overlap, as a point
// on the edge. `inside` tells whether there is one; only then is the gap of the face the Euclidean distance.
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
  if (high < 0.0 || low > length) return {};
  const double t = 0.5 * (std::max(low, 0.0) + std::min(high, length));
  return {true, tail + t * along};
}

struct Pair {
  double squared = kInfinity;
  Vec2 on_a;
  Vec2 on_b;
};

// The nearest pair of a point on an edge of `a` and a vertex of `b`, over the edges that b is wholly beyond: when a and b are
// apart, the nearest pair has such an edge in one of the two. `every_edge` drops that restriction (cores without an inside).
void nearest_over_edges(std::span<const Vec2> a, std::span<const Vec2> b, bool every_edge, bool swapped, Pair& best) {
  Vec2 tail = a.back();
  for (const Vec2 head : a) {
    const Vec2 along = head - tail;
    double side = -kInfinity;
    for (const Vec2 v : b) side = std::max(side, cross(along, v - tail));
    if (every_edge || side <= 0.0) {
      const double length2 = squared_norm(along);
      const double inverse = length2 > 0.0 ? 1.0 / length2 : 0.0;
      for (const Vec2 v : b) {
        const double t = std::clamp(dot(along, v - tail) * inverse, 0.0, 1.0);
        const Vec2 foot = tail + t * along;
        const double squared = squared_norm(v - foot);
        if (squared < best.squared) best = swapped ? Pair{squared, v, foot} : Pair{squared, foot, v};
      }
    }
    tail = head;
  }
}

Pair nearest_pair(std::span<const Vec2> a, std::span<const Vec2> b) {
  const bool flat = a.size() < 3 && b.size() < 3;
  Pair best;
  if (a.size() > 1 || flat) nearest_over_edges(a, b, flat, false, best);
  if (b.size() > 1 || flat) nearest_over_edges(b, a, flat, true, best);
  return best;
}

// Cores without an inside: points and segments. A segment's own direction must also be tried as a separating axis.
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

// Small polygons with their loops made of fixed length and without branches, so that they vectorise: the last vertex repeated up
// to N, coordinates apart. A repeated vertex is an edge of length 0: its gap is −∞ and its points are the vertex.
template <std::size_t N>
struct Packed {
  std::array<double, N + 1> x, y;
  std::array<double, N> along_x, along_y, inverse_squared;

  explicit Packed(std::span<const Vec2> polygon) {
    for (std::size_t i = 0; i < N; ++i) {
      const Vec2 v = polygon[std::min(i, polygon.size() - 1)];
      x[i] = v.x, y[i] = v.y;
    }
    x[N] = x[0], y[N] = y[0];
    for (std::size_t i = 0; i < N; ++i) {
      along_x[i] = x[i + 1] - x[i];
      along_y[i] = y[i + 1] - y[i];
      const double squared = along_x[i] * along_x[i] + along_y[i] * along_y[i];
      inverse_squared[i] = squared > 0.0 ? 1.0 / squared : 0.0;
    }
  }
};

template <std::size_t N, std::size_t M>
double packed_gap(const Packed<N>& a, const Packed<M>& b) {
  std::array<double, N> side;  // how far left of the edge's line the leftmost vertex of b is, times the edge's length
  side.fill(-kInfinity);
  for (std::size_t j = 0; j < M; ++j) {
    for (std::size_t i = 0; i < N; ++i) {
      const double z = a.along_x[i] * (b.y[j] - a.y[i]) - a.along_y[i] * (b.x[j] - a.x[i]);
      side[i] = z > side[i] ? z : side[i];
    }
  }
  double gap = -kInfinity;
  for (std::size_t i = 0; i < N; ++i) {
    const double edge_gap = a.inverse_squared[i] > 0.0 ? -side[i] * std::sqrt(a.inverse_squared[i]) : -kInfinity;
    gap = edge_gap > gap ? edge_gap : gap;
  }
  return gap;
}

// The least squared distance of a vertex of b to an edge of a.
template <std::size_t N, std::size_t M>
double packed_squared(const Packed<N>& a, const Packed<M>& b) {
  std::array<double, N> least;
  least.fill(kInfinity);
  for (std::size_t j = 0; j < M; ++j) {
    for (std::size_t i = 0; i < N; ++i) {
      const double dx = b.x[j] - a.x[i];
      const double dy = b.y[j] - a.y[i];
      const double t = (dx * a.along_x[i] + dy * a.along_y[i]) * a.inverse_squared[i];
      const double low = t > 0.0 ? t : 0.0;
      const double at = low < 1.0 ? low : 1.0;
      const double ex = dx - at * a.along_x[i];
      const double ey = dy - at * a.along_y[i];
      const double squared = ex * ex + ey * ey;
      least[i] = squared < least[i] ? squared : least[i];
    }
  }
  return *std::min_element(least.begin(), least.end());
}

template <std::size_t N, std::size_t M>
double packed_distance(std::span<const Vec2> first, std::span<const Vec2> second, double enough) {
  const Packed<N> a(first);
  const Packed<M> b(second);
  const double gap = std::max(packed_gap(a, b), packed_gap(b, a));
  if (gap <= 0.0 || gap >= enough) return gap;
  return std::sqrt(std::min(packed_squared(a, b), packed_squared(b, a)));
}

Separation apart(std::span<const Vec2> a, std::span<const Vec2> b, Vec2 fallback_normal) {
  const Pair pair = nearest_pair(a, b);
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
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // Monotone chain [Andrew79]: the lower hull from left to right, then the upper one back.
  std::vector<Vec2> hull;
  const auto extend = [&hull](Vec2 p, std::size_t floor) {
    while (hull.size() > floor && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2 p : points) extend(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();
  return hull;
}

Separation separation(std::span<const Vec2> a, std::span<const Vec2> b) {
  const Face of_a = widest_face(a, b);
  const Face of_b = widest_face(b, a);
  const bool by_a = of_a.gap >= of_b.gap;
  const Face& face = by_a ? of_a : of_b;
  if (face.gap == -kInfinity) return apart(a, b, {1.0, 0.0});  // two points
  const Vec2 normal = by_a ? face.normal : -face.normal;
  const bool flat = a.size() < 3 && b.size() < 3;
  if (flat && (face.gap >= -kTie || flat_and_apart(a, b))) return apart(a, b, normal);
  const Foot foot = by_a ? foot_on(a, b, face) : foot_on(b, a, face);
  if (!foot.inside && face.gap > 0.0) return apart(a, b, normal);
  if (!foot.inside) {  // an overlap always has its foot inside, but for rounding: any supporting vertex will do
    const Pair pair = nearest_pair(a, b);
    if (pair.squared < kInfinity) return {face.gap, normal, pair.on_a, pair.on_b};
  }
  const Vec2 opposite = foot.on_edge + face.gap * face.normal;
  return by_a ? Separation{face.gap, normal, foot.on_edge, opposite} : Separation{face.gap, normal, opposite, foot.on_edge};
}

Separation separation(const Convex& a, const Convex& b) {
  Separation result = separation(std::span<const Vec2>(a.core), std::span<const Vec2>(b.core));
  result.distance -= a.radius + b.radius;
  result.point_a += a.radius * result.normal;
  result.point_b -= b.radius * result.normal;
  return result;
}

double distance(std::span<const Vec2> a, std::span<const Vec2> b) { return distance_up_to(a, b, kInfinity); }

double distance_up_to(std::span<const Vec2> a, std::span<const Vec2> b, double enough) {
  if (a.size() < 3 && b.size() < 3) {
    const double gap = std::max(widest_face(a, b).gap, widest_face(b, a).gap);
    return gap >= -kTie || flat_and_apart(a, b) ? std::sqrt(nearest_pair(a, b).squared) : gap;
  }
  if (a.size() <= 4 && b.size() <= 4) return packed_distance<4, 4>(a, b, enough);
  if (a.size() <= 4 && b.size() <= 8) return packed_distance<4, 8>(a, b, enough);
  if (a.size() <= 8 && b.size() <= 4) return packed_distance<4, 8>(b, a, enough);
  if (a.size() <= 8 && b.size() <= 8) return packed_distance<8, 8>(a, b, enough);
  const double gap = std::max(widest_face(a, b).gap, widest_face(b, a).gap);
  return gap <= 0.0 || gap >= enough ? gap : std::sqrt(nearest_pair(a, b).squared);
}

}  // namespace seine::geom
