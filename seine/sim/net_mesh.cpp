#include "seine/sim/net_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace seine::sim {
namespace {

using geom::Vec2;
using geom::Vec3;

constexpr int kFewestRings = 5;
constexpr int kMostRings = 16;

// Area and centroid of a fan add up to those of the polygon.
Vec2 centroid(std::span<const Vec2> polygon) {
  Vec2 sum;
  double area = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const double twice = geom::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    sum += (twice / 3.0) * (polygon[0] + polygon[k - 1] + polygon[k]);
    area += twice;
  }
  return sum / area;
}

double longest_side(std::span<const Vec2> polygon) {
  double longest = geom::norm(polygon.front() - polygon.back());
  for (std::size_t k = 1; k < polygon.size(); ++k)
    longest = std::max(longest, geom::norm(polygon[k] - polygon[k - 1]));
  return longest;
}

// Builds the fan: ring i of a sector has the nodes middle + (i − j)/rings · (corner k − middle) + j/rings ·
// (corner k+1 − middle), j = 0 … i; the first and the last lie on spokes shared with the neighbours.
class Fan {
 public:
  Fan(std::span<const Vec2> rest, int rings) : rings_(rings), middle_(centroid(rest)) {
    mesh_.corners = rest.size();
    mesh_.flat.assign(rest.begin(), rest.end());
    for (int k = 0; k < corners(); ++k) {
      mesh_.sector.push_back({k, next(k)});
      mesh_.fan.push_back({1.0, 0.0});
    }
    mesh_.flat.push_back(middle_);
    mesh_.sector.push_back({0, 1});
    mesh_.fan.push_back({0.0, 0.0});
    for (int i = 1; i <= rings; ++i)
      for (int k = 0; k < corners(); ++k)
        for (int j = 0; j < i; ++j)
          if (i < rings || j > 0) add_node(k, i, j);
    for (int i = 0; i < rings; ++i)
      for (int k = 0; k < corners(); ++k) add_strip(k, i);
  }

  NetMesh finish() {
    add_cords();
    weigh();
    return std::move(mesh_);
  }

 private:
  int corners() const { return static_cast<int>(mesh_.corners); }
  int next(int k) const { return k + 1 == corners() ? 0 : k + 1; }
  Vec2 flat(int node) const { return mesh_.flat[static_cast<std::size_t>(node)]; }

  void add_node(int k, int i, int j) {
    const std::array<double, 2> fan{static_cast<double>(i - j) / rings_, static_cast<double>(j) / rings_};
    index_[{k, i, j}] = static_cast<int>(mesh_.flat.size());
    mesh_.flat.push_back(middle_ + fan[0] * (flat(k) - middle_) + fan[1] * (flat(next(k)) - middle_));
    mesh_.sector.push_back({k, next(k)});
    mesh_.fan.push_back(fan);
  }

  int node(int k, int i, int j) const {
    if (i == 0) return corners();
    if (j == i) return node(next(k), i, 0);
    if (i == rings_ && j == 0) return k;
    return index_.at({k, i, j});
  }

  // The triangles of sector k between rings i and i + 1.
  void add_strip(int k, int i) {
    for (int j = 0; j <= i; ++j) {
      mesh_.faces.push_back({node(k, i, j), node(k, i + 1, j), node(k, i + 1, j + 1)});
      if (j < i) mesh_.faces.push_back({node(k, i, j), node(k, i + 1, j + 1), node(k, i, j + 1)});
    }
  }

  void add_cords() {
    std::set<std::pair<int, int>> joined;
    for (const auto& face : mesh_.faces) {
      const Vec2 middle = (flat(face[0]) + flat(face[1]) + flat(face[2])) / 3.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(face[i], face[(i + 1) % 3]);
        if (joined.insert({a, b}).second) mesh_.cords.push_back({a, b, geom::norm(flat(a) - flat(b))});
        mesh_.face_reach = std::max(mesh_.face_reach, geom::norm(flat(a) - middle));
      }
    }
    constexpr double kNone = std::numeric_limits<double>::infinity();
    for (int k = 0; k < corners(); ++k)
      for (int v = 0; v < static_cast<int>(mesh_.flat.size()); ++v)
        mesh_.geodesics.push_back(v < corners() || joined.contains({k, v}) ? kNone
                                                                           : geom::norm(flat(k) - flat(v)));
  }

  // Each corner of a triangle carries a third of its area.
  void weigh() {
    mesh_.share.assign(mesh_.flat.size(), 0.0);
    double total = 0.0;
    for (const auto& [a, b, c] : mesh_.faces) {
      const double twice = geom::cross(flat(b) - flat(a), flat(c) - flat(a));
      assert(twice > 0.0);
      for (const int v : {a, b, c}) mesh_.share[static_cast<std::size_t>(v)] += twice / 3.0;
      total += twice;
    }
    for (double& share : mesh_.share) share /= total;
  }

  int rings_;
  Vec2 middle_;
  NetMesh mesh_;
  std::map<std::array<int, 3>, int> index_;
};

}  // namespace

NetMesh triangulate(std::span<const Vec2> rest, double spacing) {
  assert(rest.size() >= 3 && spacing > 0.0);
  const double rings = std::ceil(longest_side(rest) / spacing - 1e-9);
  return Fan(rest, static_cast<int>(std::clamp<double>(rings, kFewestRings, kMostRings))).finish();
}

std::vector<Vec3> drape(const NetMesh& mesh, std::span<const Vec3> corners, double depth) {
  assert(corners.size() == mesh.corners);
  Vec3 middle;
  for (const Vec3 corner : corners) middle = middle + (1.0 / static_cast<double>(corners.size())) * corner;
  middle.z -= depth;
  std::vector<Vec3> nodes;
  for (std::size_t v = 0; v < mesh.flat.size(); ++v) {
    const auto [a, b] = mesh.sector[v];
    const auto [s, t] = mesh.fan[v];
    nodes.push_back(middle + s * (corners[static_cast<std::size_t>(a)] - middle) +
                    t * (corners[static_cast<std::size_t>(b)] - middle));
  }
  return nodes;
}

}  // namespace seine::sim
