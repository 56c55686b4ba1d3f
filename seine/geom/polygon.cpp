#include "seine/geom/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "seine/base/error.hpp"
#include "seine/geom/box.hpp"

namespace seine::geom {
namespace {

using Indices = std::vector<std::size_t>;

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - b);
}
int side(Vec2 a, Vec2 b, Vec2 p) {
  const double z = cross(b - a, p - a);
  return (z > 0.0) - (z < 0.0);
}

// p is known to lie on the line through a and b.
bool within(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int sc = side(a, b, c);
  const int sd = side(a, b, d);
  const int sa = side(c, d, a);
  const int sb = side(c, d, b);
  if (sc * sd < 0 && sa * sb < 0) return true;
  return (sc == 0 && within(a, b, c)) || (sd == 0 && within(a, b, d)) || (sa == 0 && within(c, d, a)) ||
         (sb == 0 && within(c, d, b));
}

std::string edge_name(std::size_t i, std::size_t n) {
  return "edge " + std::to_string(i + 1) + "-" + std::to_string((i + 1) % n + 1);
}

// Edge i meets edge j > i where it should not.
bool edges_clash(std::span<const Vec2> p, std::size_t i, std::size_t j) {
  const std::size_t n = p.size();
  const Vec2 a = p[i];
  const Vec2 b = p[(i + 1) % n];
  const Vec2 c = p[j];
  const Vec2 d = p[(j + 1) % n];
  const bool follows = j == i + 1;
  const bool closes = i == 0 && j == n - 1;
  if (!follows && !closes) return segments_meet(a, b, c, d);
  // Neighbours share a vertex; they clash when one folds back onto the other.
  const Vec2 in = follows ? b - a : d - c;
  const Vec2 out = follows ? d - c : b - a;
  return cross(in, out) == 0.0 && dot(in, out) < 0.0;
}

// The edges of a ring in a binary tree of boxes: node 0 holds all, the children of node k are 2k + 1 and
// 2k + 2, and a node holds the edges [begin, end).
class EdgeTree {
 public:
  explicit EdgeTree(std::span<const Vec2> ring) : ring_(ring) { build(0, 0, ring.size()); }

  // The first edge after i that clashes with it; the number of edges when there is none.
  std::size_t first_clash(std::size_t i) const { return search(0, 0, ring_.size(), i, box_of(i)); }

 private:
  static constexpr std::size_t kLeaf = 4;  // edges
  Box box_of(std::size_t edge) const {
    Box box;
    box.include(ring_[edge]);
    box.include(ring_[(edge + 1) % ring_.size()]);
    return box;
  }
  Box build(std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= boxes_.size()) boxes_.resize(node + 1);
    Box box;
    if (end - begin <= kLeaf) {
      for (std::size_t edge = begin; edge < end; ++edge) {
        box.include(box_of(edge).low);
        box.include(box_of(edge).high);
      }
    } else {
      const std::size_t middle = begin + (end - begin) / 2;
      for (const Box& half : {build(2 * node + 1, begin, middle), build(2 * node + 2, middle, end)}) {
        box.include(half.low);
        box.include(half.high);
      }
    }
    return boxes_[node] = box;
  }
  std::size_t search(std::size_t node, std::size_t begin, std::size_t end, std::size_t i,
                     const Box& near) const {
    const std::size_t none = ring_.size();
    if (end <= i + 1 || !boxes_[node].overlaps(near)) return none;
    if (end - begin <= kLeaf) {
      for (std::size_t j = std::max(begin, i + 1); j < end; ++j)
        if (edges_clash(ring_, i, j)) return j;
      return none;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const std::size_t found = search(2 * node + 1, begin, middle, i, near);
    return found < none ? found : search(2 * node + 2, middle, end, i, near);
  }

  std::span<const Vec2> ring_;
  std::vector<Box> boxes_;
};

// Closed triangle.
bool in_triangle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  return side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0;
}

bool is_ear(std::span<const Vec2> p, const Indices& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const std::size_t before = (at + n - 1) % n;
  const std::size_t after = (at + 1) % n;
  const Vec2 a = p[ring[before]];
  const Vec2 b = p[ring[at]];
  const Vec2 c = p[ring[after]];
  if (turn(a, b, c) <= 0.0) return false;
  // Rounding may call a point inside that lies a little beyond the box.
  const double left = std::min({a.x, b.x, c.x}), right = std::max({a.x, b.x, c.x});
  const double grown = 1e-9 * (right - left) + 1e-12 * std::max(std::abs(left), std::abs(right));
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 q = p[ring[i]];
    if (q.x < left - grown || q.x > right + grown) continue;
    if (i != before && i != at && i != after && in_triangle(a, b, c, q)) return false;
  }
  return true;
}

// Straight vertices bound nothing; `tolerance` is the sine of the turn.
bool straight(Vec2 a, Vec2 b, Vec2 c, double tolerance) {
  return dot(b - a, c - b) > 0.0 && std::abs(turn(a, b, c)) <= tolerance * norm(b - a) * norm(c - b);
}

void drop_straight(std::span<const Vec2> p, Indices& ring, double tolerance) {
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const std::size_t n = ring.size();
    if (straight(p[ring[(i + n - 1) % n]], p[ring[i]], p[ring[(i + 1) % n]], tolerance)) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
}

// The same, where only ring[at − 1] and ring[at] and what follows from them may be.
void drop_straight_at(std::span<const Vec2> p, Indices& ring, std::size_t at) {
  bool dropped = true;
  while (dropped) {
    dropped = false;
    for (const std::size_t offset : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t n = ring.size(), i = (at + n - 1 + offset) % n;
      if (n <= 3 || !straight(p[ring[(i + n - 1) % n]], p[ring[i]], p[ring[(i + 1) % n]], 0.0)) continue;
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      if (i < at) --at;
      dropped = true;
      break;
    }
  }
}

// Counter-clockwise ring to triangles.
std::vector<Indices> clip_ears(std::span<const Vec2> p, Indices ring) {
  std::vector<Indices> triangles;
  std::size_t at = 0;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    std::size_t tried = 0;
    while (tried < n && !is_ear(p, ring, at % n)) ++tried, ++at;
    if (tried == n) {  // rounding has hidden the ears: what remains is thinner than the numbers can tell
      at = 0;
      double best = -1.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double z = turn(p[ring[(i + n - 1) % n]], p[ring[i]], p[ring[(i + 1) % n]]);
        if (z > best) best = z, at = i;
      }
    }
    at %= n;
    triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    // Only the neighbours of what was clipped can have become straight.
    drop_straight_at(p, ring, at);
    ++at;  // skipping one keeps the triangles from fanning round a single vertex
  }
  triangles.push_back(std::move(ring));
  return triangles;
}

// Joins `a` and `b` across the edge a[i] -> a[i+1] = b[j+1] -> b[j]; empty when the union is not convex
// there.
Indices merged(std::span<const Vec2> p, const Indices& a, std::size_t i, const Indices& b, std::size_t j) {
  Indices ring;
  for (std::size_t k = 1; k <= a.size(); ++k) ring.push_back(a[(i + k) % a.size()]);  // a[i+1] … a[i]
  for (std::size_t k = 2; k < b.size(); ++k)
    ring.push_back(b[(j + k) % b.size()]);  // b after a[i], before a[i+1]
  const std::size_t n = ring.size();
  const std::size_t joint = a.size() - 1;
  const bool convex = turn(p[ring[n - 1]], p[ring[0]], p[ring[1]]) >= 0.0 &&
                      turn(p[ring[joint - 1]], p[ring[joint]], p[ring[(joint + 1) % n]]) >= 0.0;
  return convex ? ring : Indices{};
}

// Merges parts across diagonals while they stay convex [Hertel83].
void merge_parts(std::span<const Vec2> p, std::vector<Indices>& parts) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> owner;  // directed edge -> part
  const auto claim = [&](std::size_t part) {
    const Indices& ring = parts[part];
    for (std::size_t i = 0; i < ring.size(); ++i) owner[{ring[i], ring[(i + 1) % ring.size()]}] = part;
  };
  const auto find = [](const Indices& ring, std::size_t vertex) {
    return static_cast<std::size_t>(std::find(ring.begin(), ring.end(), vertex) - ring.begin());
  };
  for (std::size_t part = 0; part < parts.size(); ++part) claim(part);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (std::size_t i = 0; i < parts[part].size();) {
      const Indices& ring = parts[part];
      const auto twin = owner.find({ring[(i + 1) % ring.size()], ring[i]});
      Indices joined;
      if (twin != owner.end() && twin->second != part) {
        const Indices& other = parts[twin->second];
        joined = merged(p, ring, i, other, find(other, ring[(i + 1) % ring.size()]));
      }
      if (joined.empty()) {
        ++i;
        continue;
      }
      const std::size_t gone = twin->second;
      const std::size_t tail = ring[i];
      const std::size_t head = ring[(i + 1) % ring.size()];
      owner.erase({tail, head});
      owner.erase({head, tail});
      parts[gone].clear();
      parts[part] = std::move(joined);
      claim(part);
      i = 0;
    }
  }
  std::erase_if(parts, [](const Indices& ring) { return ring.empty(); });
}

}  // namespace

double signed_area(std::span<const Vec2> polygon) {
  if (polygon.empty()) return 0.0;
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return 0.5 * twice;
}

bool contains(std::span<const Vec2> polygon, Vec2 point) {
  bool inside = false;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % n];
    if (side(a, b, point) == 0 && within(a, b, point)) return true;
    // A ray to the right crosses the half-open edge.
    if ((a.y > point.y) != (b.y > point.y) && (side(a, b, point) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

std::string why_not_simple(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  if (n < 3) return "a polygon needs at least 3 vertices, this has " + std::to_string(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(polygon[i].x) || !std::isfinite(polygon[i].y)) {
      return "vertex " + std::to_string(i + 1) + " is not finite";
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (polygon[i] == polygon[j]) {
      return "vertices " + std::to_string(i + 1) + " and " + std::to_string(j + 1) + " are the same point";
    }
  }
  const EdgeTree tree(polygon);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = tree.first_clash(i);
    if (j < n) return edge_name(i, n) + " and " + edge_name(j, n) + " cross or touch";
  }
  if (signed_area(polygon) == 0.0) return "the polygon has no area";
  return "";
}

std::vector<Vec2> without_repeats(std::vector<Vec2> ring) {
  double largest = 0.0;
  for (const Vec2 p : ring) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const double same = std::max(1e-9, 4.0 * std::numeric_limits<double>::epsilon() * largest);  // m
  const auto one = [same](Vec2 a, Vec2 b) { return norm(a - b) <= same; };
  std::vector<Vec2> kept;
  for (const Vec2 p : ring)
    if (kept.empty() || !one(kept.back(), p)) kept.push_back(p);
  while (kept.size() > 1 && one(kept.front(), kept.back())) kept.pop_back();
  for (std::size_t round = 3; 2 * round <= kept.size(); ++round) {
    if (kept.size() % round != 0) continue;
    const auto again = [&](std::size_t i) { return one(kept[i], kept[i % round]); };
    std::size_t i = round;
    while (i < kept.size() && again(i)) ++i;
    if (i == kept.size()) kept.resize(round);
  }
  return kept;
}

bool is_convex(std::span<const Vec2> counter_clockwise) {
  const std::size_t n = counter_clockwise.size();
  if (n < 3) return false;
  double turned = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = counter_clockwise[(i + 1) % n] - counter_clockwise[i];
    const Vec2 out = counter_clockwise[(i + 2) % n] - counter_clockwise[(i + 1) % n];
    const double angle = std::atan2(cross(in, out), dot(in, out));
    if (!(angle >= -1e-12)) return false;
    turned += angle;
  }
  // Once round, not more: a star turns left everywhere too.
  return std::abs(turned - 2.0 * std::numbers::pi) < 1e-6 && signed_area(counter_clockwise) > 0.0;
}

std::vector<std::vector<Vec2>> convex_parts(std::span<const Vec2> polygon) {
  if (const std::string why = why_not_simple(polygon); !why.empty()) throw InputError(why);
  std::vector<Vec2> points(polygon.begin(), polygon.end());
  if (signed_area(points) < 0.0) std::reverse(points.begin(), points.end());
  Indices ring(points.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = i;
  drop_straight(points, ring, 0.0);
  std::vector<Indices> parts;
  const auto points_of = [&points](const Indices& indices) {
    std::vector<Vec2> result;
    for (const std::size_t i : indices) result.push_back(points[i]);
    return result;
  };
  if (is_convex(points_of(ring))) {
    parts.push_back(ring);
  } else {
    parts = clip_ears(points, ring);
    merge_parts(points, parts);
  }
  std::vector<std::vector<Vec2>> result;
  for (Indices& part : parts) {
    drop_straight(points, part, 1e-14);
    result.push_back(points_of(part));
  }
  return result;
}

}  // namespace seine::geom
