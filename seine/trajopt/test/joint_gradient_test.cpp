#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/math/finite_difference.hpp"
#include "seine/trajopt/joint_problem.hpp"

namespace seine::trajopt {
namespace {

using geom::Vec2;

// A wavy guess of one segment from `from` towards `heading`, driven in `gear`.
SegmentGuess wavy(Rng& rng, geom::Pose2 from, int gear, double length, double wait) {
  SegmentGuess guess;
  guess.gear = gear, guess.wait = wait, guess.length = length, guess.duration = length / 1.3;
  guess.start_heading = from.heading, guess.end_heading = from.heading + rng.uniform(-0.2, 0.2);
  guess.start_curvature = rng.uniform(-0.5, 0.5), guess.end_curvature = rng.uniform(-0.5, 0.5);
  guess.start_acceleration = rng.uniform(1.0, 4.0), guess.end_deceleration = rng.uniform(1.0, 4.0);
  const int pieces = 4 + rng.below(2), times = 4 + rng.below(3);
  const Vec2 d = from.direction(), n = geom::left_normal(d);
  for (int j = 0; j <= pieces; ++j) {
    const double s = length * j / pieces;
    guess.points.push_back(from.position() + (gear * s) * d + (j == 0 ? 0.0 : 0.1 * rng.normal()) * n);
  }
  for (int j = 0; j <= times; ++j) {
    const double r = static_cast<double>(j) / times;
    guess.progress.push_back(length *
                             (r * r * (3 - 2 * r) + (j == 0 || j == times ? 0.0 : 0.02 * rng.normal())));
  }
  return guess;
}

// Three cars that cross, with waits, a cusp, a moving start, a free end, corridors, a moving body and a
// steering-rate limit: every term is active.
struct Busy {
  std::vector<RobotTask> robots;
  Body body;
  Task task;
};

void make_busy(std::uint64_t seed, bool rectangles, Busy& busy) {
  Rng rng(seed);
  Task& task = busy.task;
  for (int k = 0; k < 3; ++k) {
    RobotTask robot;
    robot.model.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
    if (!rectangles)
      robot.model.footprint = {{-0.1, -0.2}, {0.4, -0.2}, {0.5, 0.0}, {0.3, 0.22}, {-0.1, 0.2}};
    robot.model.limits = {
        .speed = 1.5, .reverse_speed = 1.0, .acceleration = 1.5, .lateral_acceleration = 1.0};
    if (k == 1) robot.model.limits.steering_rate = 0.6;
    const double heading = 2.1 * k;
    robot.start = {-1.2 * std::cos(heading), -1.2 * std::sin(heading), heading};
    robot.start_speed = k == 2 ? 0.8 : 0.0;
    robot.segments.push_back(wavy(rng, robot.start, 1, 2.5, k == 0 ? 0.4 : 0.0));
    geom::Pose2 at{robot.segments[0].points.back().x, robot.segments[0].points.back().y,
                   robot.segments[0].end_heading};
    if (k == 1) {
      robot.segments.push_back(wavy(rng, at, -1, 1.2, 0.3));
      const auto& last = robot.segments.back();
      at = {last.points.back().x, last.points.back().y, last.end_heading};
    }
    if (k > 0) robot.goal = at;
    std::vector<geom::Pose2> poses;
    for (const SegmentGuess& segment : robot.segments)
      std::ranges::move(sample_poses(segment), std::back_inserter(poses));
    poses.push_back(at);
    robot.corridor.begin.push_back(0);
    for (const geom::Pose2& pose : poses) {
      const Vec2 n = geom::unit(pose.heading + 1.4);
      robot.corridor.nx.push_back(n.x), robot.corridor.ny.push_back(n.y);
      robot.corridor.b.push_back(geom::dot(n, pose.position()) + 0.15);
      robot.corridor.begin.push_back(static_cast<int>(robot.corridor.nx.size()));
    }
    busy.robots.push_back(std::move(robot));
  }
  for (const RobotTask& robot : busy.robots) task.robots.push_back(&robot);
  task.units = units_of(busy.robots);
  task.ticks = 100;
  Body& body = busy.body;
  body.shape = shape_of(std::vector<Vec2>{{0.0, 0.0}, {0.5, 0.1}, {0.1, 0.5}}, task.units.length);
  body.radius = 0.1, body.clearance = 0.1;
  for (int tick = 0; tick < task.ticks; ++tick)
    body.placements.push_back({{0.5, 0.02 * tick}, geom::unit(0.01 * tick)});
  task.bodies.push_back(&body);
}

double worst_error(std::uint64_t seed, bool rectangles, double knee, int& kinks) {
  Workers workers(2);
  Busy busy;
  make_busy(seed, rectangles, busy);
  JointProblem problem(busy.task, Settings{}, workers);
  std::vector<double> x = problem.initial(), g(x.size()), unused(x.size());
  problem.refresh(x);
  problem.evaluate(x, g, knee);
  double worst = 0.0;
  // Entry by entry: distances have kinks, which an entry may sit on by chance.
  const auto f = [&](std::span<const double> y) { return problem.evaluate(y, unused, knee); };
  double scale = 1.0;
  for (const double v : g) scale = std::max(scale, std::abs(v));
  const auto check = math::check_gradient(f, x, g);
  if (check.worst > 2e-6) ++kinks;
  worst = check.worst;
  return worst;
}

TEST(JointProblem, GradientAgreesWithCentralDifferencesWithEveryTermActive) {
  int kinks = 0, runs = 0;
  std::vector<double> errors;
  for (const bool rectangles : {true, false})
    for (const double knee : {0.3, 0.03})
      for (std::uint64_t seed = 1; seed <= effort(6, 3); ++seed, ++runs)
        errors.push_back(worst_error(seed, rectangles, knee, kinks));
  std::sort(errors.begin(), errors.end());
  std::printf("gradient error: median %.1e, worst %.1e, over 2e-6 in %d of %d\n", errors[errors.size() / 2],
              errors.back(), kinks, runs);
  EXPECT_LT(errors[errors.size() / 2], 1e-6);
  EXPECT_LE(kinks, runs / 6);
}

TEST(JointProblem, IsTheSameForAnyNumberOfThreads) {
  std::vector<double> reference;
  for (const int threads : {1, 2, 3}) {
    Workers workers(threads);
    Busy busy;
    make_busy(3, true, busy);
    JointProblem problem(busy.task, Settings{}, workers);
    std::vector<double> x = problem.initial();
    problem.solve(x, Deadline());
    if (reference.empty()) reference = x;
    EXPECT_EQ(reference, x) << threads << " threads";
  }
}

}  // namespace
}  // namespace seine::trajopt
