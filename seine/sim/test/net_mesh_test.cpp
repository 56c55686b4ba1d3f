#include "seine/sim/net_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/polygon.hpp"

namespace seine::sim {
namespace {

std::vector<geom::Vec2> regular_polygon(std::size_t corners, double radius) {
  std::vector<geom::Vec2> polygon;
  for (std::size_t k = 0; k < corners; ++k)
    polygon.push_back(
        radius * geom::unit(2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners)));
  return polygon;
}

// Convex and counter-clockwise: points of an ellipse at irregular angles.
std::vector<geom::Vec2> random_convex(Rng& rng, std::size_t corners) {
  const double flat = rng.uniform(0.6, 1.0);
  std::vector<geom::Vec2> polygon;
  for (std::size_t k = 0; k < corners; ++k) {
    const double place = static_cast<double>(k) + rng.uniform(0.0, 0.7);
    const geom::Vec2 at = geom::unit(2.0 * std::numbers::pi * place / static_cast<double>(corners));
    polygon.push_back({at.x, flat * at.y});
  }
  return polygon;
}

using geom::Vec2;

constexpr std::uint64_t kSeed = 11;

std::vector<Vec2> corners_of(const NetMesh& mesh, const std::array<int, 3>& face) {
  std::vector<Vec2> triangle;
  for (const int node : face) triangle.push_back(mesh.flat[static_cast<std::size_t>(node)]);
  return triangle;
}

TEST(NetMesh, CoversTheNetOnceWithoutHoles) {
  Rng rng(kSeed);
  for (int round = 0; round < 30; ++round) {
    const std::vector<Vec2> rest = random_convex(rng, 3 + static_cast<std::size_t>(rng.below(6)));
    const NetMesh mesh = triangulate(rest, rng.uniform(0.1, 0.4));
    double area = 0.0;
    std::map<std::pair<int, int>, int> sides;
    for (const auto& face : mesh.faces) {
      const double a = geom::signed_area(corners_of(mesh, face));
      EXPECT_GT(a, 0.0) << "round " << round << ", seed " << kSeed;
      area += a;
      for (std::size_t i = 0; i < 3; ++i) ++sides[std::minmax(face[i], face[(i + 1) % 3])];
    }
    EXPECT_NEAR(area, geom::signed_area(rest), 1e-12);
    EXPECT_NEAR(std::accumulate(mesh.share.begin(), mesh.share.end(), 0.0), 1.0, 1e-12);
    EXPECT_EQ(sides.size(), mesh.cords.size());
    // Euler's formula for a disc: the sides met by one face only are its rim.
    EXPECT_EQ(mesh.flat.size() + mesh.faces.size(), mesh.cords.size() + 1);
    double rim = 0.0;
    for (const Cord& cord : mesh.cords) {
      const int faces = sides[std::minmax(cord.a, cord.b)];
      EXPECT_TRUE(faces == 1 || faces == 2);
      if (faces == 1) rim += cord.rest;
    }
    double around = 0.0;
    for (std::size_t k = 0; k < rest.size(); ++k) around += geom::norm(rest[k] - rest[(k + 1) % rest.size()]);
    EXPECT_NEAR(rim, around, 1e-9);
  }
}

TEST(NetMesh, EveryNodeReachesEveryCornerStraight) {
  Rng rng(kSeed);
  const std::vector<Vec2> rest = random_convex(rng, 5);
  const NetMesh mesh = triangulate(rest);
  std::map<std::pair<int, int>, double> cords;
  for (const Cord& cord : mesh.cords) cords[std::minmax(cord.a, cord.b)] = cord.rest;
  const std::size_t nodes = mesh.flat.size();
  for (std::size_t v = 5; v < nodes; ++v) {
    for (std::size_t k = 0; k < 5; ++k) {
      const auto cord = cords.find({static_cast<int>(k), static_cast<int>(v)});
      const double straight = mesh.geodesics[k * nodes + v];
      EXPECT_EQ(std::isinf(straight), cord != cords.end());
      EXPECT_NEAR(cord != cords.end() ? cord->second : straight, geom::norm(mesh.flat[v] - rest[k]), 1e-12);
    }
  }
}

TEST(NetMesh, DrapedOverItsOwnCornersItIsFlat) {
  const std::vector<Vec2> rest = regular_polygon(4, 1.4);
  const NetMesh mesh = triangulate(rest);
  std::vector<geom::Vec3> corners;
  for (const Vec2 r : rest) corners.push_back({r.x, r.y, 1.0});
  const std::vector<geom::Vec3> nodes = drape(mesh, corners, 0.0);
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    EXPECT_NEAR(geom::norm(nodes[v].ground() - mesh.flat[v]), 0.0, 1e-12);
    EXPECT_NEAR(nodes[v].z, 1.0, 1e-12);
  }
  EXPECT_NEAR(drape(mesh, corners, 0.3)[4].z, 0.7, 1e-12);
}

}  // namespace
}  // namespace seine::sim
