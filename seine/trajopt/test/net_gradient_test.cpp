#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/math/finite_difference.hpp"
#include "seine/trajopt/joint_problem.hpp"

namespace seine::trajopt {
namespace {

using geom::Vec2;

constexpr std::size_t kCars = 4;

// Four cars around a square net, wavy and out of step enough that size, topology, opening, obstacles above
// and below, a catch, a delivery with a heading, a cusp and a wait are all violated somewhere.
struct Team {
  world::Scenario scene;
  std::unique_ptr<world::StaticMap> tall;
  NetTask net;
  std::vector<RobotTask> robots;
  Task task;
};

SegmentGuess wavy(Rng& rng, geom::Pose2 from, int gear, double length) {
  SegmentGuess guess;
  guess.gear = gear, guess.length = length, guess.duration = length / 1.3;
  guess.start_heading = from.heading, guess.end_heading = from.heading + rng.uniform(-0.2, 0.2);
  guess.start_curvature = rng.uniform(-0.5, 0.5), guess.end_curvature = rng.uniform(-0.5, 0.5);
  guess.start_acceleration = rng.uniform(1.0, 4.0), guess.end_deceleration = rng.uniform(1.0, 4.0);
  constexpr int kPieces = 5, kTimes = 6;
  const Vec2 d = from.direction(), n = geom::left_normal(d);
  for (int j = 0; j <= kPieces; ++j) {
    const double s = length * j / kPieces;
    guess.points.push_back(from.position() + (gear * s) * d + (j == 0 ? 0.0 : 0.12 * rng.normal()) * n);
  }
  for (int j = 0; j <= kTimes; ++j) {
    const double r = static_cast<double>(j) / kTimes;
    guess.progress.push_back(length *
                             (r * r * (3 - 2 * r) + (j == 0 || j == kTimes ? 0.0 : 0.02 * rng.normal())));
  }
  return guess;
}

void make_net(Rng& rng, Team& team) {
  for (std::size_t k = 0; k < kCars; ++k) {
    team.net.net.rest.push_back(std::numbers::sqrt2 *
                                geom::unit(0.5 * std::numbers::pi * static_cast<double>(k)));
    team.net.net.attachments.push_back({{0.2, 0.05}, 1.0});
  }
  CatchTask c;
  c.time = 1.7, c.point = {1.6 + rng.uniform(-0.2, 0.2), 0.3}, c.margin = 0.9;
  c.contact_delay = 0.1, c.contact_margin = 0.8, c.lean = 0.4, c.velocity = {3.0, -2.0},
  c.most_sideways = 1.0;
  c.least_opening = 1.4, c.held_opening = 1.3, c.hold = 0.5;
  c.least_spread = 1.9, c.most_radius = 0.8;
  team.net.net.stretch = 0.7;
  team.net.catches = {c};
  team.net.loaded_from = 1.7;
  team.net.holding_reserve = 6.0;
  team.net.delivery = net::Delivery{{2.6, 0.8}, 0.2, 0.5};
  team.scene.bounds = {{-10.0, -10.0}, {10.0, 10.0}};
  world::Obstacle post;
  post.shape = world::Circle{{1.9, 0.9}, 0.15};
  world::Obstacle block;
  block.shape = std::vector<Vec2>{{0.6, -1.5}, {1.0, -1.4}, {0.7, -1.0}};
  team.scene.obstacles = {post, block};
  team.tall = std::make_unique<world::StaticMap>(team.scene);
  team.net.tall = team.tall.get();
  team.net.low.push_back({{{{2.0, -0.5}, {2.4, -0.5}, {2.2, -0.2}}, 0.0}, 0.3});
}

void make_team(std::uint64_t seed, Team& team) {
  Rng rng(seed);
  make_net(rng, team);
  for (std::size_t k = 0; k < kCars; ++k) {
    RobotTask robot;
    robot.model.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
    robot.model.limits = {
        .speed = 1.5, .reverse_speed = 1.0, .acceleration = 1.5, .lateral_acceleration = 1.0};
    const Vec2 at = 0.72 * team.net.net.rest[k];
    robot.start = {at.x, at.y, 0.1 * rng.normal()};
    robot.segments.push_back(wavy(rng, robot.start, 1, 2.4));
    const SegmentGuess& first = robot.segments[0];
    robot.segments.push_back(
        wavy(rng, {first.points.back().x, first.points.back().y, first.end_heading}, -1, 1.1));
    robot.segments[1].wait = 0.2;
    team.robots.push_back(std::move(robot));
  }
  for (const RobotTask& robot : team.robots) team.task.robots.push_back(&robot);
  team.task.units = units_of(team.robots);
  team.task.ticks = 140;
  team.task.tick = 0.04;
  team.task.net = &team.net;
  team.task.one_timing = true;
}

TEST(NetTerms, GradientWithOneTimingAgreesWithCentralDifferences) {
  std::vector<double> errors;
  for (const double knee : {0.3, 0.03})
    for (std::uint64_t seed = 1; seed <= effort(5, 2); ++seed) {
      Workers workers(2);
      Team team;
      make_team(seed, team);
      JointProblem problem(team.task, Settings{}, workers);
      std::vector<double> x = problem.initial(), g(x.size()), unused(x.size());
      problem.refresh(x);
      problem.evaluate(x, g, knee);
      const auto f = [&](std::span<const double> y) { return problem.evaluate(y, unused, knee); };
      errors.push_back(math::check_gradient(f, x, g).worst);
    }
  std::sort(errors.begin(), errors.end());
  std::printf("gradient error with a net: median %.1e, worst %.1e\n", errors[errors.size() / 2],
              errors.back());
  EXPECT_LT(errors[errors.size() / 2], 1e-6);
  // Distances have kinks, which an entry may sit on by chance.
  EXPECT_LT(errors[errors.size() * 3 / 4], 2e-6);
}

TEST(NetTerms, EveryTermIsFelt) {
  // Each change of the task must change the cost: a term that is silent here would not be tested above.
  Workers workers(1);
  const auto cost_of = [&](const std::function<void(Team&)>& change) {
    Team team;
    make_team(5, team);
    change(team);
    JointProblem problem(team.task, Settings{}, workers);
    std::vector<double> x = problem.initial(), g(x.size());
    problem.refresh(x);
    return problem.evaluate(x, g, 0.1);
  };
  const double all = cost_of([](Team&) {});
  const auto felt = [&](const char* what, const std::function<void(Team&)>& change) {
    EXPECT_LT(cost_of(change), all - 1e-3) << what;
  };
  felt("size", [](Team& t) { t.net.size = false; });
  felt("stretch", [](Team& t) { t.net.net.stretch = 5.0; });
  felt("drag", [](Team& t) {
    for (net::Attachment& a : t.net.net.attachments) a.height = 3.0;
  });
  felt("holding", [](Team& t) { t.net.holding_reserve = 0.0; });
  felt("rim margin", [](Team& t) { t.net.catches[0].margin = -5.0; });
  felt("contact margin", [](Team& t) { t.net.catches[0].contact_margin = -5.0; });
  felt("lean", [](Team& t) { t.net.catches[0].lean = 0.0; });
  felt("sideways", [](Team& t) { t.net.catches[0].most_sideways = 1e9; });
  felt("opening", [](Team& t) { t.net.catches[0].least_opening = 0.0; });
  felt("held opening", [](Team& t) { t.net.catches[0].held_opening = 0.0; });
  felt("depth", [](Team& t) { t.net.catches[0].least_spread = 0.0; });
  felt("flatness", [](Team& t) { t.net.catches[0].most_radius = 1e9; });
  felt("delivery", [](Team& t) { t.net.delivery->radius = 50.0; });
  felt("delivery heading", [](Team& t) { t.net.delivery->heading.reset(); });
  felt("tall obstacles", [](Team& t) { t.net.tall = nullptr; });
  felt("low obstacles", [](Team& t) { t.net.low.clear(); });
}

TEST(NetTerms, OneTimingMovesAllCarsTogether) {
  Workers workers(1);
  Team team;
  make_team(2, team);
  JointProblem problem(team.task, Settings{}, workers);
  std::vector<double> x = problem.initial();
  problem.solve(x, Deadline());
  const traj::TeamTrajectory plan = problem.trajectory(x);
  for (const traj::RobotTrajectory& robot : plan.robots) {
    EXPECT_EQ(robot.arrival(), plan.robots[0].arrival());
    ASSERT_EQ(robot.segments.size(), 2u);
    EXPECT_EQ(robot.segments[1].wait, plan.robots[0].segments[1].wait);
  }
}

}  // namespace
}  // namespace seine::trajopt
