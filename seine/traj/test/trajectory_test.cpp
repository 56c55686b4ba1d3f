#include "seine/traj/trajectory.hpp"

#include <gtest/gtest.h>

#include "seine/base/rng.hpp"

namespace seine::traj {
namespace {

using geom::Vec2;

/// The progress of one piece from u0 to u1, at rest at both ends.
Quintic rest_to_rest(double u0, double u1) {
  const double d = u1 - u0;
  return {u0, 0.0, 0.0, 10.0 * d, -15.0 * d, 6.0 * d};
}

/// One bent curve piece, driven once.
Segment random_segment(Rng& rng, int gear) {
  Segment segment;
  segment.gear = gear;
  segment.piece_duration = rng.uniform(0.5, 3.0);
  Quintic x{}, y{};
  for (double& c : x) c = 0.2 * rng.normal();
  for (double& c : y) c = 0.2 * rng.normal();
  const Vec2 way = 3.0 * geom::unit(rng.uniform(-3.1, 3.1));
  x[1] += way.x, y[1] += way.y;
  segment.curve = {{x, y}};
  segment.progress = {rest_to_rest(0.0, 1.0)};
  return segment;
}

// The flat map is checked by what its quantities mean, not by repeating its formulas: v is the velocity along
// the heading, a_t its derivative, κ = θ̇ / v, a_n = v θ̇, and there is no velocity across the heading.
TEST(Evaluate, StatesAreDerivativesOfEachOther) {
  const std::uint64_t seed = 5;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Rng rng(seed);
  for (int trial = 0; trial < 100; ++trial) {
    const Segment segment = random_segment(rng, trial % 2 == 0 ? 1 : -1);
    for (int i = 0; i < 10; ++i) {
      const double step = 1e-5, t = rng.uniform(0.1, 0.9) * segment.duration();
      const State a = evaluate(segment, t - step), s = evaluate(segment, t), b = evaluate(segment, t + step);
      const Vec2 velocity = (b.pose.position() - a.pose.position()) / (2.0 * step);
      const double turn = geom::wrap_angle(b.pose.heading - a.pose.heading) / (2.0 * step);
      const double scale = 1e-6 * (1.0 + std::abs(s.acceleration) + s.curvature * s.curvature);
      EXPECT_GT(segment.gear * s.speed, 0.0);
      EXPECT_NEAR(geom::dot(velocity, s.pose.direction()), s.speed, scale);
      EXPECT_NEAR(geom::cross(velocity, s.pose.direction()), 0.0, scale);
      EXPECT_NEAR((b.speed - a.speed) / (2.0 * step), s.acceleration, 10.0 * scale);
      EXPECT_NEAR(turn, s.curvature * s.speed, 10.0 * scale);
      EXPECT_NEAR(s.lateral_acceleration, s.speed * turn, 10.0 * scale * (1.0 + std::abs(s.speed)));
      const double rate = (b.curvature - a.curvature) / (2.0 * step);
      EXPECT_NEAR(rate, s.curvature_rate, 1e-4 * (1.0 + std::abs(rate)));
    }
  }
}

TEST(Evaluate, ClampsItsTimeAndKeepsDirectionAtRest) {
  Rng rng(6);
  for (const int gear : {1, -1}) {
    const Segment segment = random_segment(rng, gear);
    const State before = evaluate(segment, -1.0), after = evaluate(segment, segment.duration() + 1.0);
    EXPECT_EQ(before.t, 0.0);
    EXPECT_EQ(after.t, segment.duration());
    EXPECT_EQ(before.speed, 0.0);
    EXPECT_NEAR(after.speed, 0.0, 1e-12);
    const Vec2 way = evaluate(segment, 0.01 * segment.duration()).pose.position() - before.pose.position();
    EXPECT_GT(gear * geom::dot(way, before.pose.direction()), 0.0);
  }
}

TEST(RobotTrajectory, WaitsRestsAndArrives) {
  Rng rng(7);
  Segment first = random_segment(rng, 1), second = random_segment(rng, -1);
  first.wait = 0.5;
  second.wait = 1.5;
  const RobotTrajectory way{{first, second}};
  const double middle = first.wait + first.duration();
  EXPECT_DOUBLE_EQ(way.arrival(), middle + second.wait + second.duration());
  EXPECT_DOUBLE_EQ((TeamTrajectory{{way, RobotTrajectory{{first}}}}.makespan()), way.arrival());

  const State start = evaluate(first, 0.0), goal = evaluate(second, second.duration());
  for (const double t : {-3.0, 0.0, 0.3}) {
    EXPECT_EQ(way.at(t).pose, start.pose);
    EXPECT_EQ(way.at(t).speed, 0.0);
    EXPECT_EQ(way.at(t).acceleration, 0.0);
    EXPECT_EQ(way.at(t).t, t);
  }
  EXPECT_EQ(way.at(middle + 0.7).pose, evaluate(second, 0.0).pose);
  EXPECT_EQ(way.at(middle + 0.7).speed, 0.0);
  EXPECT_NEAR(way.at(0.5 + 0.2).speed, evaluate(first, 0.2).speed, 1e-12);
  EXPECT_NEAR(way.at(middle + 1.5 + 0.2).speed, evaluate(second, 0.2).speed, 1e-12);
  EXPECT_EQ(way.at(way.arrival() + 100.0).pose, goal.pose);
  EXPECT_EQ(way.at(way.arrival() + 100.0).acceleration, 0.0);
  EXPECT_EQ(way.at(way.arrival() + 100.0).curvature, goal.curvature);
}

TEST(Evaluate, AKnotBelongsToThePieceOnItsRight) {
  Segment segment;
  segment.piece_duration = 1.0;
  segment.curve = {{Quintic{0.0, 1.0}, Quintic{}}, {Quintic{1.0, 1.0, 0.0, 1.0}, Quintic{}}};
  segment.progress = {Quintic{0.0, 1.0}, Quintic{1.0, 1.0}};
  EXPECT_DOUBLE_EQ(evaluate(segment, 1.0).pose.x, 1.0);
  EXPECT_DOUBLE_EQ(evaluate(segment, 1.5).pose.x, 1.0 + 0.5 + 0.125);
  EXPECT_DOUBLE_EQ(evaluate(segment, 2.0).pose.x, 3.0);
}

}  // namespace
}  // namespace seine::traj
