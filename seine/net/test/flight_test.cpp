#include "seine/net/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "seine/base/rng.hpp"

namespace seine::net {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 7;

Target random_target(Rng& rng, double drag) {
  Target target;
  target.time = rng.uniform(0.0, 2.0);
  target.position = {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(0.5, 4.0)};
  target.velocity = {rng.uniform(-6.0, 6.0), rng.uniform(-6.0, 6.0), rng.uniform(-2.0, 8.0)};
  target.drag = drag;
  return target;
}

Vec3 pull(double drag, Vec3 v) {
  return Vec3{0.0, 0.0, -9.80665} + (-drag * norm(v)) * v;
}

// Midpoint rule with very small steps.
FlightState integrated(const Target& target, double t) {
  FlightState s{target.time, target.position, target.velocity};
  const int steps = 40'000;
  const double h = (t - target.time) / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec3 middle = s.velocity + (0.5 * h) * pull(target.drag, s.velocity);
    s.position = s.position + h * middle;
    s.velocity = s.velocity + h * pull(target.drag, middle);
  }
  s.time = t;
  return s;
}

TEST(Flight, FollowsItsEquationOfMotion) {
  Rng rng(kSeed);
  for (const double drag : {0.0, 0.01, 0.15, 0.8, 5.0}) {
    for (int round = 0; round < 10; ++round) {
      const Target target = random_target(rng, drag);
      const Flight flight(target);
      const double t = target.time + rng.uniform(0.0, 2.5);
      const FlightState expected = integrated(target, t);
      const FlightState got = flight.at(t);
      EXPECT_EQ(got.time, t);
      EXPECT_LT(norm(got.position - expected.position), 1e-6) << "drag " << drag << ", seed " << kSeed;
      EXPECT_LT(norm(got.velocity - expected.velocity), 1e-6) << "drag " << drag << ", seed " << kSeed;
    }
  }
}

TEST(Flight, BeginsAtItsReleaseAndIsContinuous) {
  Rng rng(kSeed + 1);
  for (const double drag : {0.0, 0.3}) {
    const Target target = random_target(rng, drag);
    const Flight flight(target);
    EXPECT_EQ(flight.at(target.time - 0.5).position, target.position);
    EXPECT_EQ(flight.at(target.time).velocity, target.velocity);
    for (double t = target.time; t < target.time + 1.5; t += 1e-3) {
      const FlightState a = flight.at(t);
      const FlightState b = flight.at(t + 1e-7);
      EXPECT_LT(norm(b.position - a.position - 1e-7 * a.velocity), 1e-9);
    }
  }
}

TEST(Crossing, IsTheLastFallThroughTheHeight) {
  Rng rng(kSeed + 2);
  int crossed = 0;
  for (int round = 0; round < 200; ++round) {
    const Target target = random_target(rng, round % 2 == 0 ? 0.0 : rng.uniform(0.01, 1.0));
    const Flight flight(target);
    const double height = rng.uniform(0.3, 3.0);
    const auto crossing = flight.crossing(height);
    double highest = target.position.z;
    for (double t = target.time; t < target.time + 3.0; t += 4e-3)
      highest = std::max(highest, flight.at(t).position.z);
    if (std::abs(highest - height) > 1e-3) {
      EXPECT_EQ(crossing.has_value(), highest > height) << "round " << round << ", seed " << kSeed + 2;
    }
    if (!crossing) continue;
    ++crossed;
    EXPECT_GE(crossing->state.time, target.time);
    EXPECT_NEAR(crossing->state.position.z, height, 1e-8);
    EXPECT_LT(crossing->state.velocity.z, 0.0);
    EXPECT_LT(norm(flight.at(crossing->state.time).position - crossing->state.position), 1e-12);
    for (double s = 1e-3; s < 1.0; s += 5e-2)
      EXPECT_LT(flight.at(crossing->state.time + s).position.z, height);
  }
  EXPECT_GT(crossed, 100);
}

TEST(Crossing, NeverHappensBelowTheRimOrInTouchingIt) {
  Target target;
  target.position = {0.0, 0.0, 0.5};
  target.velocity = {1.0, 0.0, 2.0};
  EXPECT_FALSE(Flight(target).crossing(1.0).has_value());
  const double apex = 0.5 + 2.0 * 2.0 / (2.0 * kGravity);
  EXPECT_FALSE(Flight(target).crossing(apex + 1e-12).has_value());
  EXPECT_TRUE(Flight(target).crossing(apex - 1e-6).has_value());
  target.position.z = 1.0;
  target.velocity.z = -1.0;
  EXPECT_TRUE(Flight(target).crossing(1.0).has_value());
}

TEST(Crossing, AFeatherStillComesDown) {
  Target target;
  target.position = {0.0, 0.0, 2.0};
  target.velocity = {3.0, 0.0, 2.0};
  target.drag = 20.0;  // falls at 0.7 m/s
  const auto crossing = Flight(target).crossing(1.0);
  ASSERT_TRUE(crossing.has_value());
  EXPECT_NEAR(norm(crossing->state.velocity), std::sqrt(kGravity / target.drag), 1e-3);
}

using Matrix6 = std::array<std::array<double, 6>, 6>;

// L Lᵀ for a random lower triangular L: position errors of some 20 mm, velocity errors of some 50 mm/s.
Matrix6 random_factor(Rng& rng) {
  Matrix6 l{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) l[i][j] = (i < 3 ? 0.01 : 0.025) * rng.normal();
  return l;
}

TEST(Crossing, ItsEllipseIsThatOfManyDisturbedFlights) {
  Rng rng(kSeed + 3);
  for (const double drag : {0.0, 0.1, 0.6}) {
    Target target = random_target(rng, drag);
    target.position.z = 2.5;
    const Matrix6 l = random_factor(rng);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t k = 0; k < 6; ++k) target.covariance[i][j] += l[i][k] * l[j][k];
    const auto crossing = Flight(target).crossing(1.0);
    ASSERT_TRUE(crossing.has_value());
    constexpr int kSamples = 2000;
    std::array<double, 3> sum{};
    for (int s = 0; s < kSamples; ++s) {
      std::array<double, 6> z{};
      std::array<double, 6> e{};
      for (double& x : z) x = rng.normal();
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t k = 0; k <= i; ++k) e[i] += l[i][k] * z[k];
      Target other = target;
      other.position = other.position + Vec3{e[0], e[1], e[2]};
      other.velocity = other.velocity + Vec3{e[3], e[4], e[5]};
      const geom::Vec2 off =
          Flight(other).crossing(1.0)->state.position.ground() - crossing->state.position.ground();
      sum[0] += off.x * off.x, sum[1] += off.x * off.y, sum[2] += off.y * off.y;
    }
    const double scale = crossing->covariance[0] + crossing->covariance[2];
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(sum[i] / kSamples, crossing->covariance[i], 0.1 * scale)
          << "drag " << drag << ", seed " << kSeed + 3;
    // The half axis is the largest deviation over all directions.
    double widest = 0.0;
    for (double angle = 0.0; angle < 3.15; angle += 1e-3) {
      const geom::Vec2 u = geom::unit(angle);
      const auto& c = crossing->covariance;
      widest = std::max(widest, u.x * u.x * c[0] + 2.0 * u.x * u.y * c[1] + u.y * u.y * c[2]);
    }
    EXPECT_NEAR(crossing->error, 2.0 * std::sqrt(widest), 1e-5 * crossing->error);
  }
}

TEST(Crossing, AnExactTargetHasNoError) {
  Rng rng(kSeed + 4);
  Target target = random_target(rng, 0.2);
  target.position.z = 3.0;
  EXPECT_EQ(Flight(target).crossing(1.0)->error, 0.0);
}

}  // namespace
}  // namespace seine::net
