// The enemy's own geometry by hand-made examples.
#include "bench/deceive/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seine::deceive {
namespace {

const Polygon kSquare{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

Polygon moved(Polygon polygon, double dx, double dy) {
  for (geom::Vec2& p : polygon) p += {dx, dy};
  return polygon;
}

TEST(Shapes, DistancesOfSquares) {
  EXPECT_DOUBLE_EQ(convex_distance(kSquare, moved(kSquare, 1.5, 0.2)), 0.5);
  EXPECT_DOUBLE_EQ(convex_distance(kSquare, moved(kSquare, 4.0, 5.0)), 5.0);
  EXPECT_NEAR(convex_distance(kSquare, moved(kSquare, 0.9, 0.3)), -0.1, 1e-15);
  EXPECT_DOUBLE_EQ(polygon_distance(kSquare, moved(kSquare, 4.0, 5.0)), 5.0);
}

TEST(Shapes, ACrossHasNoVertexInside) {
  const Polygon wide{{-1.0, 0.4}, {2.0, 0.4}, {2.0, 0.6}, {-1.0, 0.6}};
  const Polygon high{{0.4, -1.0}, {0.6, -1.0}, {0.6, 2.0}, {0.4, 2.0}};
  EXPECT_EQ(polygon_distance(wide, high), 0.0);
  EXPECT_NEAR(convex_distance(kSquare, wide), -0.6, 1e-15);
}

TEST(Shapes, ANotchIsOutside) {
  const Polygon notched{{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {2.0, 3.0},
                        {2.0, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {0.0, 3.0}};
  EXPECT_FALSE(inside({1.5, 2.0}, notched));
  EXPECT_TRUE(inside({1.5, 0.5}, notched));
  const Polygon small{{1.4, 2.0}, {1.6, 2.0}, {1.6, 2.2}, {1.4, 2.2}};
  EXPECT_NEAR(polygon_distance(small, notched), 0.4, 1e-15);
}

TEST(Shapes, Discs) {
  EXPECT_DOUBLE_EQ(disc_distance(kSquare, {4.0, 5.0}, 2.0), 3.0);
  EXPECT_DOUBLE_EQ(disc_distance(kSquare, {0.5, 0.5}, 0.2), -0.7);
}

TEST(Shapes, Placed) {
  const Polygon there = placed(kSquare, {2.0, 3.0, std::acos(-1.0) / 2.0});
  EXPECT_NEAR(there[1].x, 2.0, 1e-15);
  EXPECT_NEAR(there[1].y, 4.0, 1e-15);
}

}  // namespace
}  // namespace seine::deceive
