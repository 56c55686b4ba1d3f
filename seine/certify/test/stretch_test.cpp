// The bounds of second derivatives, and of the tangent's length, against finite differences inside the
// interval.
#include "seine/certify/stretch.hpp"

#include <gtest/gtest.h>

#include "seine/certify/test/plans.hpp"

namespace seine::certify::test {
namespace {

constexpr double kWheelbase = 0.4;

Quintic random_quintic(Rng& rng, double spread) {
  Quintic c{};
  for (double& value : c) value = spread * rng.normal();
  return c;
}

TEST(Stretch, BendsBoundSecondDerivatives) {
  Rng rng(21);
  int checked = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Quintic x = random_quintic(rng, 0.3), y = random_quintic(rng, 0.3), progress = random_quintic(rng, 0.15);
    x[1] += 2.0;
    progress[0] = rng.uniform(0.0, 1.0);
    const Stretch stretch{.drive = {.x = &x, .y = &y, .progress = &progress, .h = rng.uniform(0.3, 2.0)}};
    const double width = rng.uniform(0.01, 0.2), w0 = rng.uniform(0.0, 1.0 - width), w1 = w0 + width;
    const Vec2 corner{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)};
    const Bends bends = stretch.bends(w0, w1, kWheelbase, geom::norm(corner));
    if (!(bends.least_length > 0.3)) continue;
    ++checked;
    for (int i = 0; i < 30; ++i) {
      const double step = 0.02 * width, w = rng.uniform(w0 + step, w1 - step), dt = step * stretch.drive.h;
      const Sample a = stretch.sample(w - step, kWheelbase), b = stretch.sample(w, kWheelbase),
                   c = stretch.sample(w + step, kWheelbase);
      for (std::size_t q = 0; q < kQuantities; ++q) {
        if (q == curvature) continue;  // its variable is u: below
        const double second = (a.value[q] - 2.0 * b.value[q] + c.value[q]) / (dt * dt);
        EXPECT_LE(std::abs(second), bends.value[q] * (1.0 + 1e-6) + 1e-3) << "quantity " << q;
      }
      const auto at = [&](const Sample& s) {
        return s.frame.position + corner.x * s.frame.forward + corner.y * geom::left_normal(s.frame.forward);
      };
      const Vec2 acceleration = (at(a) - 2.0 * at(b) + at(c)) / (dt * dt);
      EXPECT_LE(geom::norm(acceleration), bends.vertex * (1.0 + 1e-6) + 1e-3);
      EXPECT_LE(std::abs(b.u - stretch.sample(0.5 * (w0 + w1), kWheelbase).u), bends.half_range + 1e-12);
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(Stretch, CurvatureBendsByTheCurveParameter) {
  Rng rng(22);
  const Quintic identity{0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  for (int trial = 0; trial < 200; ++trial) {
    Quintic x = random_quintic(rng, 0.3), y = random_quintic(rng, 0.3);
    x[1] += 2.0;
    const Stretch stretch{.drive = {.x = &x, .y = &y, .progress = &identity}};
    const double w0 = rng.uniform(0.0, 0.9), w1 = w0 + 0.1, step = 1e-3;
    const Bends bends = stretch.bends(w0, w1, kWheelbase, 1.0);
    if (!(bends.least_length > 0.3)) continue;
    for (double w = w0 + step; w < w1 - step; w += 5e-3) {
      const auto kappa = [&](double at) { return stretch.sample(at, kWheelbase).value[curvature]; };
      const double second = (kappa(w - step) - 2.0 * kappa(w) + kappa(w + step)) / (step * step);
      EXPECT_LE(std::abs(second), bends.value[curvature] * (1.0 + 1e-6) + 1e-3);
    }
  }
}

TEST(Stretch, SamplesAgreeWithTheTrajectory) {
  Rng rng(23);
  const auto way =
      random_way(rng, {{1.0, 2.0, 0.5}, 0.3}, {.segments = 1, .curve_pieces = 1, .progress_pieces = 1});
  const traj::Segment& segment = way.segments.front();
  const Stretch stretch{.drive = traj::drive_on(segment, 0, 0)};
  for (double w = 0.0; w <= 1.0; w += 0.05) {
    const Sample sample = stretch.sample(w, kWheelbase);
    const traj::State state = traj::evaluate(segment, w * segment.piece_duration);
    const double gear = segment.gear, z = kWheelbase * state.curvature;
    EXPECT_NEAR(sample.frame.position.x, state.pose.x, 1e-12);
    EXPECT_NEAR(geom::norm(sample.frame.forward - state.pose.direction()), 0.0, 1e-12);
    EXPECT_NEAR(geom::norm(stretch.frame(w).position - sample.frame.position), 0.0, 1e-12);
    EXPECT_NEAR(gear * sample.value[pace], state.speed, 1e-12);
    EXPECT_NEAR(gear * sample.value[tangential], state.acceleration, 1e-12);
    EXPECT_NEAR(gear * sample.value[curvature], state.curvature, 1e-12);
    EXPECT_NEAR(gear * sample.value[lateral], state.lateral_acceleration, 1e-12);
    EXPECT_NEAR(gear * sample.value[steering_rate], kWheelbase * state.curvature_rate / (1.0 + z * z), 1e-12);
  }
}

}  // namespace
}  // namespace seine::certify::test
