#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "seine/geom/vec2.hpp"
#include "seine/geom/vec3.hpp"

namespace seine::sim {

/// A piece of string between two nodes: resists being stretched beyond `rest`, nothing else.
struct Cord {
  int a = 0;
  int b = 0;
  double rest = 0.0;  ///< m
};

/// A net cut into triangles. Nodes 0 … corners − 1 are the corners, node `corners` is the middle.
struct NetMesh {
  std::size_t corners = 0;
  std::vector<geom::Vec2> flat;  ///< nodes of the net spread flat, m
  std::vector<double> share;     ///< of the net's mass at each node; they add up to 1
  std::vector<Cord> cords;       ///< the sides of the triangles
  /// From corner k to node v straight over the flat net, m: geodesics[k · nodes + v]; infinite where a cord
  /// joins them.
  std::vector<double> geodesics;
  double face_reach = 0.0;                 ///< m, the farthest a corner of a face is from its middle
  std::vector<std::array<int, 3>> faces;   ///< counter-clockwise seen from above
  std::vector<std::array<int, 2>> sector;  ///< of a node: between which two corners it lies
  std::vector<std::array<double, 2>> fan;  ///< flat = middle + Σ fan[i] (corner sector[i] − middle)
};

/// How far apart neighbouring nodes on the rim are at most, m.
inline constexpr double kMeshSpacing = 0.2;

/// A fan of triangles from the middle to each side of a convex net, each cut evenly, with sides on the rim no
/// longer than `spacing` (m). Straight cords run from the middle to every corner.
NetMesh triangulate(std::span<const geom::Vec2> rest, double spacing = kMeshSpacing);

/// Places for all nodes: as the flat net, with the corners in `corners` and the middle `depth` (m) below
/// their mean.
std::vector<geom::Vec3> drape(const NetMesh& mesh, std::span<const geom::Vec3> corners, double depth);

}  // namespace seine::sim
