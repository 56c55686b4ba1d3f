#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/baseline/letter/catch_cost.hpp"
#include "seine/baseline/letter/smooth_distance.hpp"
#include "seine/baseline/letter/time_map.hpp"
#include "seine/geom/convex.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr std::uint64_t kSeed = 20266;

TEST(TimeMap, IsADiffeomorphismToPositiveDurations) {
  double last = 0.0;
  for (double tau = -30.0; tau < 30.0; tau += 0.01) {
    const double duration = duration_of(tau);
    EXPECT_GT(duration, last);
    EXPECT_NEAR(tau_of(duration), tau, 1e-9 * (1.0 + tau * tau));
    last = duration;
  }
  EXPECT_DOUBLE_EQ(duration_of(0.0), 1.0);
  EXPECT_DOUBLE_EQ(duration_slope(-1e-300), duration_slope(1e-300));
}

// A random convex polygon about the origin.
std::vector<Vec2> polygon(Rng& rng) {
  std::vector<Vec2> points;
  for (int i = 0; i < 12; ++i) points.push_back({rng.uniform(-0.6, 0.6), rng.uniform(-0.4, 0.4)});
  return geom::convex_hull(points);
}

struct Pair {
  Shape a, b;
  Stand at, there;
  double exact;  // Euclidean, by the distance the certificate uses
};

Pair draw_pair(Rng& rng) {
  const std::vector<Vec2> a = polygon(rng), b = polygon(rng);
  const Pose2 at{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-3.0, 3.0)};
  const Pose2 there{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-3.0, 3.0)};
  return {Shape(a),
          Shape(b),
          {at.position(), at.direction()},
          {there.position(), there.direction()},
          geom::separation(geom::placed({a, 0.0}, at), geom::placed({b, 0.0}, there)).distance};
}

TEST(SmoothDistance, IsALowerBoundAfterItsErrorIsTakenOff) {
  Rng rng(kSeed);
  for (int i = 0; i < 3000; ++i) {
    const Pair pair = draw_pair(rng);
    const double alpha = 60.0;
    StandGradient unused;
    const double smooth = smooth_distance(pair.a, pair.at, pair.b, pair.there, alpha, unused);
    const double hard = hard_distance(pair.a, pair.at, pair.b, pair.there);
    const double up = smoothing_error(pair.a, pair.b, alpha);
    const double down =
        std::log(static_cast<double>(std::max(pair.a.corners.size(), pair.b.corners.size()))) / alpha;
    EXPECT_LE(smooth - up, hard + 1e-12);
    EXPECT_GE(smooth, hard - down - 1e-12);
    EXPECT_LE(hard, pair.exact + 1e-9) << "the separating gap is never more than the distance";
    if (pair.exact < 0.0) {
      EXPECT_NEAR(hard, pair.exact, 1e-9) << "and is the depth where they overlap";
    }
  }
}

TEST(SmoothDistance, PairsLeftOutAreFarApart) {
  Rng rng(kSeed);
  int left_out = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pair pair = draw_pair(rng);
    const double wanted = rng.uniform(-0.2, 0.4);
    if (may_be_near(pair.a, pair.at, pair.b, pair.there, wanted)) continue;
    ++left_out;
    EXPECT_GE(hard_distance(pair.a, pair.at, pair.b, pair.there), wanted);
  }
  EXPECT_GT(left_out, 100);
}

TEST(Clamp, JoinsItsPiecesOnceDifferentiably) {
  constexpr double kEpsilon = 0.1, kStep = 1e-9;
  for (const double joint : {0.0, kEpsilon, 1.0 - kEpsilon, 1.0}) {
    double before, after;
    EXPECT_NEAR(clamped(joint - kStep, kEpsilon, before), clamped(joint + kStep, kEpsilon, after),
                4.0 * kStep);
    EXPECT_NEAR(before, after, 1e-6) << "at " << joint;
  }
  // The supplement of the last piece, as the letter prints it.
  double unused;
  const double e = kEpsilon, x = 0.96;
  EXPECT_NEAR(clamped(x, e, unused),
              -x * x * x / (e * e) + (3.0 - 2.0 * e) * x * x / (e * e) + (4.0 * e - 3.0) * x / (e * e) +
                  (e - 1.0) * (e - 1.0) / (e * e),
              1e-12);
}

TEST(CatchCost, JoinsItsPiecesOnceDifferentiably) {
  const CatchWeights weights{3.0, 11.0, 0.2};
  for (const double joint : {-weights.blend, weights.blend}) {
    double before, after;
    EXPECT_NEAR(catch_cost(joint - 1e-9, weights, before), catch_cost(joint + 1e-9, weights, after), 1e-7);
    EXPECT_NEAR(before, after, 1e-6);
  }
  double slope;
  EXPECT_DOUBLE_EQ(catch_cost(0.0, weights, slope), 0.0);
  EXPECT_DOUBLE_EQ(slope, 7.0) << "half way between both weights";
}

TEST(CatchCost, TheDistanceIsThatToTheRing) {
  Rng rng(kSeed);
  constexpr double kClamp = 1e-6;  // as good as none
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Vec2> ring = polygon(rng);
    const Vec2 p{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)};
    std::vector<Vec2> unused(ring.size());
    const std::vector<Vec2> point{p};
    const double outside =
        geom::separation(std::span<const Vec2>(ring), std::span<const Vec2>(point)).distance;
    EXPECT_NEAR(net_distance(ring, p, kClamp, unused), outside, 1e-5) << "seed " << kSeed << ", case " << i;
  }
}

}  // namespace
}  // namespace seine::baseline::letter
