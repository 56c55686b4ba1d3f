#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/baseline/letter/problem.hpp"
#include "seine/math/finite_difference.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr int kSeeds = 4;

// A wavy segment of `pieces` pieces from a pose, driven in `gear`.
SegmentTask wavy(Rng& rng, const Pose2& from, int gear, double length, int pieces) {
  SegmentTask task{.gear = gear, .piece_duration = length / (rng.uniform(1.2, 1.4) * pieces)};
  const Vec2 d = from.direction(), n = geom::left_normal(d);
  for (int j = 0; j <= pieces; ++j)
    task.points.push_back(from.position() + (gear * length * j / pieces) * d +
                          (j == 0 ? 0.0 : 0.08 * rng.normal()) * n);
  task.start_heading = from.heading;
  task.end_heading = from.heading + rng.uniform(-0.3, 0.3);
  return task;
}

// A plane or two at every sample, close enough to be felt.
void add_corridor(RobotTask& robot, const Settings& settings) {
  corridor::Corridor& corridor = robot.corridor;
  corridor.begin.push_back(0);
  for (const SegmentTask& segment : robot.segments)
    for (int j = 0; j < segment.pieces(); ++j) {
      const bool end = j == 0 || j + 1 == segment.pieces();
      for (int i = 0; i <= (end ? settings.end_intervals : settings.intervals); ++i) {
        const Vec2 at = segment.points[static_cast<std::size_t>(j)],
                   n = geom::unit(segment.start_heading + 1.4);
        corridor.nx.push_back(n.x), corridor.ny.push_back(n.y), corridor.b.push_back(geom::dot(n, at) + 0.15);
        corridor.begin.push_back(static_cast<int>(corridor.b.size()));
      }
    }
}

// Four cars that hold a net too small for them in a ring that folds, come close to each other, drive too fast
// and turn too hard, with a gear change, a catch and a delivery: every term is active.
TeamTask busy(std::uint64_t seed, const Settings& settings) {
  Rng rng(seed);
  TeamTask task;
  NetTask net;
  for (int k = 0; k < 4; ++k) {
    RobotTask robot;
    robot.model.footprint =
        k % 2 == 0 ? vehicle::rectangle_footprint(0.6, 0.4, 0.1)
                   : std::vector<Vec2>{{-0.1, -0.2}, {0.4, -0.2}, {0.5, 0.0}, {0.3, 0.22}, {-0.1, 0.2}};
    robot.model.limits = {.speed = 1.1,
                          .reverse_speed = 0.9,
                          .acceleration = 1.0,
                          .lateral_acceleration = 0.4,
                          .steering = 0.3};
    const Vec2 at = (0.4 + 0.1 * rng.uniform()) * geom::unit(1.57 * k + rng.uniform(-0.5, 0.5));
    const Pose2 start{at.x, at.y, rng.uniform(-0.3, 0.3)};
    robot.segments.push_back(wavy(rng, start, 1, 2.0, 3 + rng.below(2)));
    if (k == 1) {
      const Vec2 cusp = robot.segments[0].points.back();
      robot.segments.push_back(wavy(rng, {cusp.x, cusp.y, robot.segments[0].end_heading}, -1, 1.0, 3));
    }
    robot.free_end = true;
    add_corridor(robot, settings);
    task.robots.push_back(std::move(robot));
    net.attachments.push_back({0.1, 0.05});
    net.longest.push_back(0.3);
  }
  task.robot_clearance = 0.1;
  net.meetings = {{{0.7, 0.2}, 0.6}, {{5.0, 1.0}, 9.0}};
  net.delivery = NetTask::Region{{0.5, 0.5}, 0.2};
  task.net = net;
  return task;
}

// Softer than in use, so that a finite difference does not step over the knee.
Settings soft() {
  Settings settings;
  settings.knee = 0.3, settings.smoothing = 20.0, settings.clamp = 0.2, settings.blend = 0.3;
  settings.weight.fill(30.0);
  settings.jerk_weight = 1e-3;  // else its large gradient would hide errors of the others
  settings.end_weight = 30.0, settings.centring = 10.0, settings.catching = 60.0;
  settings.intervals = 4, settings.end_intervals = 6;
  settings.topology_margin = 0.4;
  return settings;
}

TEST(LetterProblem, GradientAgreesWithCentralDifferencesWithEveryTermActive) {
  int kinks = 0;
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Workers workers(2);
    const Settings settings = soft();
    const TeamTask task = busy(seed, settings);
    Problem problem(task, settings, workers);
    std::vector<double> x = problem.initial(), g(x.size()), unused(x.size());
    problem.evaluate(x, g);
    const Claim claim = problem.claim(x, {});
    for (std::size_t i = 0; i < kLimits; ++i)
      EXPECT_GT(claim.worst[i], 0.0) << "limit " << i << " is idle, seed " << seed;
    const auto check =
        math::check_gradient([&](std::span<const double> y) { return problem.evaluate(y, unused); }, x, g);
    errors.push_back(check.worst);
    kinks += check.worst > 1e-6;
  }
  std::sort(errors.begin(), errors.end());
  std::printf("gradient error: median %.1e, worst %.1e, over 1e-6 in %d of %d\n", errors[kSeeds / 2],
              errors.back(), kinks, kSeeds);
  EXPECT_LE(kinks, 1);
}

TEST(LetterProblem, IsTheSameForAnyNumberOfThreads) {
  std::vector<double> reference;
  for (const int threads : {1, 2, 3}) {
    Workers workers(threads);
    Settings settings = soft();
    settings.evaluations = 60;
    const TeamTask task = busy(3, settings);
    Problem problem(task, settings, workers);
    std::vector<double> x = problem.initial();
    problem.solve(x, Deadline());
    if (reference.empty()) reference = x;
    EXPECT_EQ(reference, x) << threads << " threads";
  }
}

}  // namespace
}  // namespace seine::baseline::letter
