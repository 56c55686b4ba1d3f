#include "seine/geom/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"

namespace seine::geom {
namespace {

constexpr std::uint64_t kSeed = 7;

std::vector<Convex> random_pieces(Rng& rng, int count, const Box& box, double size) {
  std::vector<Convex> pieces;
  for (int i = 0; i < count; ++i) {
    const Vec2 center{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
    std::vector<Vec2> points(static_cast<std::size_t>(1 + rng.below(7)));
    for (Vec2& p : points)
      p = center + rng.uniform(0.2, 1.0) * size * unit(rng.uniform(0.0, 2.0 * std::numbers::pi));
    pieces.push_back({convex_hull(points), rng.below(3) == 0 ? size * rng.uniform() : 0.0});
  }
  return pieces;
}

double brute_force(const std::vector<Convex>& pieces, Vec2 p, double cap) {
  double best = cap;
  for (const Convex& piece : pieces) best = std::min(best, separation({{p}, 0.0}, piece).distance);
  return best;
}

// Every bound holds at random points (also beyond the grid); `slack` is how far node values may fall short
// beyond `exact_to`.
void expect_sound(const std::vector<Convex>& pieces, const DistanceField& field, double exact_to,
                  double slack, Rng& rng) {
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p{rng.uniform(-1.0, 11.0), rng.uniform(-1.0, 9.0)};
    ASSERT_LE(field.lower_bound(p), brute_force(pieces, p, field.cap))
        << "seed " << kSeed << " at " << p.x << ", " << p.y;
  }
  for (int i = 0; i < 1000; ++i) {
    const int column = rng.below(field.width);
    const int row = rng.below(field.height);
    const Vec2 p{field.origin.x + column * field.cell, field.origin.y + row * field.cell};
    const double truth = brute_force(pieces, p, field.cap);
    ASSERT_GE(field.lower_bound(p), truth - (truth < exact_to ? 2e-5 : slack)) << "seed " << kSeed;
    ASSERT_NEAR(field.value(p), field.lower_bound(p), 1e-6);
  }
}

TEST(DistanceField, IsExactAtNodesAndBelowTheTruthBetweenWhenPiecesAreFew) {
  Rng rng(kSeed);
  const Box box{{0.0, 0.0}, {10.0, 8.0}};
  for (int scene = 0; scene < 10; ++scene) {
    const std::vector<Convex> pieces = random_pieces(rng, 1 + rng.below(10), box, 0.8);
    const DistanceField field = distance_field(pieces, box, 0.1, 1.5);
    expect_sound(pieces, field, 1.5, 2e-5, rng);
  }
}

TEST(DistanceField, IsExactNearbyAndADiagonalShortAfarWhenPiecesAreMany) {
  Rng rng(kSeed);
  const Box box{{0.0, 0.0}, {10.0, 8.0}};
  for (int scene = 0; scene < effort(10, 3); ++scene) {
    const Box quarter{{0.0, 0.0}, {5.0, 4.0}};
    const std::vector<Convex> pieces = random_pieces(rng, 300, quarter, 0.05);
    const double cell = rng.uniform(0.07, 0.13);
    const DistanceField field = distance_field(pieces, box, cell, 2.5);
    expect_sound(pieces, field, cell, cell * std::numbers::sqrt2 + 2e-5, rng);
  }
}

TEST(DistanceField, WithoutPiecesEverythingIsFar) {
  const DistanceField field = distance_field(std::span<const Convex>{}, {{0.0, 0.0}, {1.0, 2.0}}, 0.3, 5.0);
  EXPECT_EQ(field.width, 5);
  EXPECT_EQ(field.height, 8);
  EXPECT_DOUBLE_EQ(field.value({0.5, 0.5}), 5.0);
}

}  // namespace
}  // namespace seine::geom
