#include "seine/vehicle/reeds_shepp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "seine/base/rng.hpp"

namespace seine::vehicle {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kSeed = 20240917;

geom::Pose2 random_pose(Rng& rng, double extent) {
  return {rng.uniform(-extent, extent), rng.uniform(-extent, extent), rng.uniform(-kPi, kPi)};
}

double length(const geom::Pose2& a, const geom::Pose2& b, double radius) {
  return reeds_shepp(a, b, radius).length;
}

void expect_pose(const geom::Pose2& got, const geom::Pose2& want, double tolerance) {
  EXPECT_NEAR(got.x, want.x, tolerance);
  EXPECT_NEAR(got.y, want.y, tolerance);
  EXPECT_NEAR(geom::wrap_angle(got.heading - want.heading), 0.0, tolerance);
}

TEST(ReedsShepp, EveryCandidateEndsAtTheGoal) {
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  std::array<ReedsSheppPath, 8> best;
  for (int i = 0; i < 20000; ++i) {
    const double radius = rng.uniform(0.3, 4.0);
    const auto from = random_pose(rng, 8), to = random_pose(rng, 8);
    const DrivingCosts costs{rng.uniform(1.0, 2.0), rng.uniform(0.0, 5.0)};
    const int count = reeds_shepp(from, to, radius, costs, best);
    ASSERT_GE(count, 1);
    double last = 0.0;
    for (int k = 0; k < count; ++k) {
      const auto& path = best[static_cast<std::size_t>(k)];
      expect_pose(pose_at(from, path, path.length), to, 1e-7 * (1.0 + path.length));
      EXPECT_GE(path.cost, last);
      last = path.cost;
      double driven = 0.0, cost = 0.0;
      int gear = 0;
      for (const Arc& arc : path.arcs()) {
        driven += std::abs(arc.distance);
        cost += arc.distance > 0 ? arc.distance : -costs.reverse * arc.distance;
        if (gear == -arc.gear()) cost += costs.gear_change;
        gear = arc.gear();
        EXPECT_LE(std::abs(arc.curvature), 1.0 / radius);
      }
      EXPECT_NEAR(driven, path.length, 1e-9);
      EXPECT_NEAR(cost, path.cost, 1e-8);
    }
  }
}

TEST(ReedsShepp, IsAMetric) {
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const double extent = i % 2 == 0 ? 2.0 : 6.0;
    const auto a = random_pose(rng, extent), b = random_pose(rng, extent), c = random_pose(rng, extent);
    const double ab = length(a, b, 1.0);
    EXPECT_GE(ab, std::hypot(a.x - b.x, a.y - b.y) - 1e-9);
    EXPECT_GE(ab, std::abs(geom::wrap_angle(a.heading - b.heading)) - 1e-9);
    EXPECT_NEAR(ab, length(b, a, 1.0), 1e-7) << "driving back is as long";
    EXPECT_LE(ab, length(a, c, 1.0) + length(c, b, 1.0) + 1e-7) << "triangle inequality";
    // Mirrored left and right.
    EXPECT_NEAR(ab, length({a.x, -a.y, -a.heading}, {b.x, -b.y, -b.heading}, 1.0), 1e-7);
    EXPECT_NEAR(2.5 * ab, length({2.5 * a.x, 2.5 * a.y, a.heading}, {2.5 * b.x, 2.5 * b.y, b.heading}, 2.5),
                1e-6);
  }
}

/// No random drive of a few arcs may be shorter than the path said to be shortest.
TEST(ReedsShepp, NothingDrivenIsShorter) {
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  for (int i = 0; i < 100000; ++i) {
    geom::Pose2 pose{};
    double driven = 0.0;
    const int arcs = 1 + rng.below(5);
    for (int k = 0; k < arcs; ++k) {
      const Arc arc{static_cast<double>(rng.below(3) - 1) * (rng.below(4) == 0 ? rng.uniform() : 1.0),
                    rng.uniform(-2, 2)};
      pose = drive(pose, arc);
      driven += std::abs(arc.distance);
    }
    ASSERT_LE(length({}, pose, 1.0), driven + 1e-7) << "case " << i;
  }
}

TEST(ReedsShepp, ClosedForms) {
  EXPECT_NEAR(length({}, {3, 0, 0}, 1.0), 3.0, 1e-12);
  EXPECT_NEAR(length({}, {-3, 0, 0}, 1.0), 3.0, 1e-12);
  EXPECT_NEAR(length({}, {0, 2, kPi}, 1.0), kPi, 1e-9);
  EXPECT_NEAR(length({}, {1, 1, kPi / 2}, 1.0), kPi / 2, 1e-9);
  EXPECT_NEAR(length({}, {0, 0, kPi}, 1.0), kPi, 1e-9) << "turning on the spot: three sixths of a circle";
  EXPECT_NEAR(length({}, {0, 0, 0}, 1.0), 0.0, 1e-12);
  // Left, straight, left: the straight joins two unit circles around (0, 1) and (5, 5), a quarter turn is
  // shared.
  EXPECT_NEAR(length({}, {6, 5, kPi / 2}, 1.0), std::hypot(5.0, 4.0) + kPi / 2, 1e-9);
}

TEST(ReedsShepp, GearChangesCanBePricedOut) {
  std::array<ReedsSheppPath, 8> best;
  // To one's left: the shortest way has gear changes; at 100 m each the winner drives in one gear.
  ASSERT_GT(reeds_shepp({}, {0, 1, 0}, 1.0, {1.0, 100.0}, best), 0);
  const int gear = best[0].arc[0].gear();
  for (const Arc& arc : best[0].arcs()) EXPECT_EQ(arc.gear(), gear);
  EXPECT_LT(length({}, {0, 1, 0}, 1.0), best[0].length);
}

TEST(ReedsShepp, PosesAlongThePathAreContinuous) {
  Rng rng(kSeed);
  for (int i = 0; i < 200; ++i) {
    const auto from = random_pose(rng, 3), to = random_pose(rng, 3);
    const auto path = reeds_shepp(from, to, 0.8);
    geom::Pose2 last = from;
    for (double s = 0.0; s <= path.length; s += 0.01) {
      const auto pose = pose_at(from, path, s);
      EXPECT_LE(std::hypot(pose.x - last.x, pose.y - last.y), 0.01 + 1e-12);
      EXPECT_LE(std::abs(geom::wrap_angle(pose.heading - last.heading)), 0.01 / 0.8 + 1e-12);
      last = pose;
    }
    expect_pose(pose_at(from, path, path.length + 1.0), to, 1e-8);
  }
}

/// The shortest of the six Dubins words by brute force: every pair of end turns, the middle solved by the
/// definition (a word that ends at the goal), turns in steps too fine to miss one.
double shortest_forwards_by_sampling(const geom::Pose2& from, const geom::Pose2& to, double radius) {
  double best = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 720;
  for (const double first : {1.0, -1.0}) {
    for (int i = 0; i < kSteps; ++i) {
      const double t = 2.0 * kPi * i / kSteps;
      const geom::Pose2 a = drive(from, first / radius, t * radius);
      for (const double last : {1.0, -1.0}) {
        // Back from the goal: after a straight the last turn begins where the heading is that of `a`.
        const double v = std::fmod(last * (to.heading - a.heading) + 8.0 * kPi, 2.0 * kPi);
        const geom::Pose2 b = drive(to, last / radius, -v * radius);
        const geom::Vec2 gap = b.position() - a.position();
        const double along = geom::dot(gap, a.direction());
        if (along < 0.0 || std::abs(geom::cross(a.direction(), gap)) > 0.01 * radius) continue;
        best = std::min(best, (t + v) * radius + along);
      }
    }
  }
  return best;
}

TEST(ReedsShepp, WithoutAReverseGearEveryGoalHasADubinsWord) {
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  std::array<ReedsSheppPath, 8> best;
  for (int i = 0; i < 3000; ++i) {
    const double radius = rng.uniform(0.3, 4.0), extent = i % 2 == 0 ? 8.0 : radius;
    const auto from = random_pose(rng, extent), to = random_pose(rng, extent);
    const bool ahead = i % 3 != 0;
    DrivingCosts costs;
    (ahead ? costs.reverse : costs.forward) = std::numeric_limits<double>::infinity();
    const int count = reeds_shepp(from, to, radius, costs, best);
    ASSERT_GE(count, 2);
    for (int k = 0; k < count; ++k) {
      const auto& path = best[static_cast<std::size_t>(k)];
      expect_pose(pose_at(from, path, path.length), to, 1e-7 * (1.0 + path.length));
      for (const Arc& arc : path.arcs()) EXPECT_EQ(arc.gear(), ahead ? 1 : -1);
    }
    if (ahead && i < 300) {
      EXPECT_LE(best[0].length, shortest_forwards_by_sampling(from, to, radius) + 0.1 * radius);
    }
  }
}

}  // namespace
}  // namespace seine::vehicle
