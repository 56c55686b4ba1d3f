#include "seine/net/catch_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/net/test/nets.hpp"

namespace seine::net {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 5;

TEST(SpeedLimit, IsWhatWasMeasuredForNinetyPercentOpenNets) {
  const double triangle = 2.2 / std::sqrt(3.0) * std::sqrt(1.0 - 0.81);
  const double square = 2.0 / std::sqrt(2.0) * std::sqrt(1.0 - 0.81);
  for (const auto& [rebound, low, high] :
       {std::tuple{0.25, 10.0, 10.7}, {0.3, 8.2, 8.8}, {0.4, 5.9, 6.3}, {0.5, 4.5, 4.8}}) {
    EXPECT_NEAR(speed_limit(triangle, 0.08, rebound), low, 0.06);
    EXPECT_NEAR(speed_limit(square, 0.08, rebound), high, 0.06);
  }
  EXPECT_EQ(speed_limit(square, 0.08, 0.2), kMaxSpeed);
  EXPECT_EQ(speed_limit(0.05, 0.08, 0.2), 0.0);
  for (const double speed : {2.0, 6.0, 10.5})
    EXPECT_NEAR(speed_limit(stopping_depth(speed, 0.08, 0.2), 0.08, 0.2), speed, 1e-9);
}

TEST(ImpactDrop, GrowsWithSpeedAndTheRootOfTheMass) {
  EXPECT_DOUBLE_EQ(impact_drop(0.0, 0.25), 0.08);
  EXPECT_DOUBLE_EQ(impact_drop(10.0, 0.25), 0.32);
  EXPECT_DOUBLE_EQ(impact_drop(10.0, 1.0), 0.56);
}

TEST(MeasureCatch, OfAStraightFallIntoTheMiddle) {
  const Net net = net_of(regular_polygon(4, std::sqrt(2.0)));
  Target target;
  target.position = {3.0, 1.0, 4.0};
  const auto crossing = Flight(target).crossing(net.rim());
  std::vector<Vec2> hold = regular_polygon(4, 0.9 * std::sqrt(2.0), 0.25 * std::numbers::pi);
  for (Vec2& a : hold) a += Vec2{3.0, 1.0};
  const Catch c = measure_catch(net, target, *crossing, hold, {});
  const double depth = std::sqrt(2.0 * 0.19);
  const double speed = std::sqrt(2.0 * kGravity * 3.0);
  EXPECT_NEAR(c.time, std::sqrt(6.0 / kGravity), 1e-12);
  EXPECT_NEAR(c.rim_margin, 0.9 - 0.08, 1e-9);
  EXPECT_NEAR(c.contact_margin, 0.9 - 0.08, 1e-9);
  EXPECT_NEAR(c.opening, 0.9, 1e-12);
  EXPECT_NEAR(c.depth, depth, 1e-9);
  EXPECT_NEAR(c.angle, 0.0, 1e-12);
  EXPECT_NEAR(c.speed, speed, 1e-9);
  EXPECT_NEAR(c.bottom, 1.0 - depth - 0.08 - 0.024 * speed, 1e-9);
}

TEST(MeasureCatch, ASlantedFlightMeetsTheNetFurtherOn) {
  const Net net = net_of(regular_polygon(4, std::sqrt(2.0)));
  Target target;
  target.position = {0.0, 0.0, 3.0};
  target.velocity = {2.0, 0.0, 0.0};
  target.covariance[1][1] = 0.01 * 0.01;
  const auto crossing = Flight(target).crossing(net.rim());
  const Vec2 at = crossing->state.position.ground();
  std::vector<Vec2> hold = regular_polygon(4, 0.9 * std::sqrt(2.0), 0.25 * std::numbers::pi);
  for (Vec2& a : hold) a += at;
  const Catch c = measure_catch(net, target, *crossing, hold, {{0.5, 0.0}, {}});
  const double falling = std::sqrt(2.0 * kGravity * 2.0);
  EXPECT_NEAR(c.angle, std::atan(1.5 / falling), 1e-9);
  EXPECT_NEAR(c.speed, std::hypot(1.5, falling), 1e-9);
  EXPECT_NEAR(c.rim_margin, 0.9 - 0.08 - 0.02, 1e-9);
  EXPECT_NEAR(c.contact_margin, 0.9 - c.depth * 1.5 / falling - 0.08 - 0.02, 1e-9);
}

TEST(MeasureCatch, AnObjectInANetThatSpeedsUpWeighsBackwards) {
  const Net net = net_of(regular_polygon(4, std::sqrt(2.0)));
  Target target;
  target.position = {0.0, 0.0, 3.0};
  const auto crossing = Flight(target).crossing(net.rim());
  std::vector<Vec2> hold = regular_polygon(4, 0.9 * std::sqrt(2.0), 0.25 * std::numbers::pi);
  for (Vec2& a : hold) a.x += 0.3;  // the edge behind is nearer
  const Catch even = measure_catch(net, target, *crossing, hold, {});
  EXPECT_NEAR(even.contact_margin, 0.6 - 0.08, 1e-9);
  const Catch faster = measure_catch(net, target, *crossing, hold, {{}, {2.0, 0.0}});
  EXPECT_NEAR(faster.contact_margin, 0.6 - faster.depth * 2.0 / kGravity - 0.08, 1e-9);
  EXPECT_EQ(faster.rim_margin, even.rim_margin);
  // Nothing is gained by braking: it meets the net before it is moved.
  EXPECT_NEAR(measure_catch(net, target, *crossing, hold, {{}, {-2.0, 0.0}}).contact_margin, 0.6 - 0.08,
              1e-9);
}

TEST(MeasureCatch, IsTheSameFromAMovingFrame) {
  Rng rng(kSeed);
  for (int round = 0; round < 50; ++round) {
    const Net net = net_of(random_convex(rng, 3 + static_cast<std::size_t>(rng.below(4))));
    const std::vector<Vec2> hold = random_hold(rng, net.rest);
    Target target;
    target.position = {rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(1.5, 3.0)};
    target.velocity = {rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)};
    const Vec2 drift{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)};
    Target drifting = target;
    drifting.velocity = target.velocity + geom::Vec3{drift.x, drift.y, 0.0};
    const auto a = Flight(target).crossing(1.0);
    const auto b = Flight(drifting).crossing(1.0);
    std::vector<Vec2> moved = hold;
    for (Vec2& p : moved) p += b->state.time * drift;
    const Catch c = measure_catch(net, target, *a, hold, {{0.3, 0.1}, {}});
    const Catch d = measure_catch(net, drifting, *b, moved, {Vec2{0.3, 0.1} + drift, {}});
    EXPECT_NEAR(c.rim_margin, d.rim_margin, 1e-9) << "round " << round << ", seed " << kSeed;
    EXPECT_NEAR(c.contact_margin, d.contact_margin, 1e-9);
    EXPECT_NEAR(c.angle, d.angle, 1e-9);
    EXPECT_NEAR(c.speed, d.speed, 1e-9);
    EXPECT_NEAR(c.bottom, d.bottom, 1e-9);
  }
}

}  // namespace
}  // namespace seine::net
