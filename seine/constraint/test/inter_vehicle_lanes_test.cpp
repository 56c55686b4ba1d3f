#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/constraint/inter_vehicle.hpp"

namespace seine::constraint {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 20271;

struct BoxPair {
  OrientedBox a, b;
};

OrientedBox random_box(Rng& rng, double reach, double heading) {
  return {{rng.uniform(-reach, reach), rng.uniform(-reach, reach)},
          geom::unit(heading),
          rng.uniform(-0.3, 0.5),
          rng.uniform(0.2, 1.0),
          rng.uniform(0.1, 0.6)};
}

// Everything from deep overlap to a few lengths apart.
std::vector<BoxPair> random_pairs(Rng& rng, std::size_t count) {
  std::vector<BoxPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = rng.uniform(0.1, 2.5);
    pairs.push_back(
        {random_box(rng, reach, rng.uniform(-3.2, 3.2)), random_box(rng, reach, rng.uniform(-3.2, 3.2))});
  }
  return pairs;
}

// @param count of the lanes that hold pairs
void compute(const std::vector<BoxPair>& pairs, std::size_t begin, std::size_t count, PairLanes& lanes) {
  for (std::size_t j = 0; j < count; ++j) put(pairs[begin + j].a, pairs[begin + j].b, lanes, j);
  inter_vehicle(lanes, static_cast<int>(count));
}

// The plain function's gradient in the lanes' form: by b's position and by both headings.
std::array<double, 4> plain_gradient(const BoxPair& pair) {
  PairGradient g;
  inter_vehicle(pair.a, pair.b, g);
  return {g.position_b.x, g.position_b.y, geom::cross(pair.a.direction, g.direction_a),
          geom::cross(pair.b.direction, g.direction_b)};
}

TEST(PairLanes, AgreeWithThePlainFunctionForAnyCount) {
  Rng rng(kSeed);
  int kinks = 0, total = 0;
  double worst = 0.0;
  for (int round = 0; round < 400; ++round) {
    const auto count = static_cast<std::size_t>(1 + rng.below(PairLanes::kLanes));
    const std::vector<BoxPair> pairs = random_pairs(rng, count);
    PairLanes lanes;
    compute(pairs, 0, count, lanes);
    for (std::size_t j = 0; j < count; ++j, ++total) {
      PairGradient unused;
      EXPECT_NEAR(lanes.gap[j], inter_vehicle(pairs[j].a, pairs[j].b, unused), 1e-12) << "seed " << kSeed;
      const std::array<double, 4> lane{lanes.normal_x[j], lanes.normal_y[j], lanes.turn_a[j],
                                       lanes.turn_b[j]},
          plain = plain_gradient(pairs[j]);
      double error = 0.0;
      for (std::size_t i = 0; i < 4; ++i) error = std::max(error, std::abs(lane[i] - plain[i]));
      // Two features may tie but for rounding; then either gradient is right.
      if (error > 1e-9)
        ++kinks;
      else
        worst = std::max(worst, error);
    }
  }
  std::printf("gradients: worst difference %.1e, at a kink %d of %d\n", worst, kinks, total);
  EXPECT_LE(kinks, total / 1000) << "seed " << kSeed;
}

TEST(PairLanes, GradientAgreesWithCentralDifferences) {
  Rng rng(kSeed + 1);
  constexpr double kStep = 1e-6;
  int kinks = 0, total = 0;
  const auto moved = [](OrientedBox box, Vec2 by, double turn) {
    const Vec2 d = geom::unit(turn);
    box.position += by;
    box.direction = {box.direction.x * d.x - box.direction.y * d.y,
                     box.direction.x * d.y + box.direction.y * d.x};
    return box;
  };
  for (const BoxPair& pair : random_pairs(rng, 2000)) {
    // Lane 0 is the pair itself, then two lanes for each of x, y, heading of a, heading of b.
    std::vector<BoxPair> around{pair};
    for (const double h : {kStep, -kStep}) {
      around.push_back({pair.a, moved(pair.b, {h, 0.0}, 0.0)});
      around.push_back({pair.a, moved(pair.b, {0.0, h}, 0.0)});
      around.push_back({moved(pair.a, {}, h), pair.b});
      around.push_back({pair.a, moved(pair.b, {}, h)});
    }
    PairLanes lanes;
    compute(around, 0, around.size(), lanes);
    const double gradient[] = {lanes.normal_x[0], lanes.normal_y[0], lanes.turn_a[0], lanes.turn_b[0]};
    for (std::size_t i = 0; i < 4; ++i, ++total)
      if (std::abs((lanes.gap[1 + i] - lanes.gap[5 + i]) / (2.0 * kStep) - gradient[i]) > 1e-5) ++kinks;
  }
  std::printf("central differences: near a kink %d of %d\n", kinks, total);
  EXPECT_LE(kinks, total / 500) << "seed " << kSeed + 1;
}

// Parallel and right-angled boxes, edges in line, corner on corner, one inside the other, one on the other:
// exact ties, where only the value is defined.
TEST(PairLanes, KeepTheValueWhereFeaturesTie) {
  std::vector<BoxPair> pairs;
  for (const double heading : {0.0, 0.5 * std::numbers::pi, std::numbers::pi, 0.25 * std::numbers::pi})
    for (const double x : {0.0, 0.5, 1.0, 1.5, 2.0})
      for (const double y : {0.0, 0.25, 0.5, 1.0, 2.0})
        pairs.push_back(
            {{{0.0, 0.0}, {1.0, 0.0}, 0.0, 0.5, 0.25}, {{x, y}, geom::unit(heading), 0.0, 0.5, 0.25}});
  for (std::size_t begin = 0; begin < pairs.size(); begin += PairLanes::kLanes) {
    const std::size_t count = std::min<std::size_t>(PairLanes::kLanes, pairs.size() - begin);
    PairLanes lanes;
    compute(pairs, begin, count, lanes);
    for (std::size_t j = 0; j < count; ++j) {
      PairGradient unused;
      EXPECT_NEAR(lanes.gap[j], inter_vehicle(pairs[begin + j].a, pairs[begin + j].b, unused), 1e-12);
      EXPECT_NEAR(std::hypot(lanes.normal_x[j], lanes.normal_y[j]), 1.0, 1e-9);
      EXPECT_TRUE(std::isfinite(lanes.turn_a[j]) && std::isfinite(lanes.turn_b[j]));
    }
  }
}

// A lane's result depends on nothing but its own pair.
TEST(PairLanes, AreIndependentOfTheirNeighbours) {
  Rng rng(kSeed + 2);
  const std::vector<BoxPair> pairs = random_pairs(rng, PairLanes::kLanes);
  PairLanes together, alone;
  compute(pairs, 0, pairs.size(), together);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    compute(pairs, j, 1, alone);
    EXPECT_EQ(together.gap[j], alone.gap[0]);
    EXPECT_EQ(together.normal_x[j], alone.normal_x[0]);
    EXPECT_EQ(together.turn_a[j], alone.turn_a[0]);
    EXPECT_EQ(together.turn_b[j], alone.turn_b[0]);
  }
}

}  // namespace
}  // namespace seine::constraint
