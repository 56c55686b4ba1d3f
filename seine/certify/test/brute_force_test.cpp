// The certificate against a 10 kHz look at the same plans, with limits and margins set just around what that
// look finds.
#include "seine/certify/test/brute_force.hpp"

#include <gtest/gtest.h>

#include "seine/base/effort.hpp"
#include "seine/certify/tolerances.hpp"

namespace seine::certify::test {
namespace {

constexpr int kLimitPlans = effort(150, 8), kDistancePlans = effort(60, 2);
constexpr double kRate = 10000.0;  // Hz

Shape random_shape(Rng& rng) {
  const int segments = 1 + rng.below(3);
  return {.segments = segments,
          .curve_pieces = 2 + rng.below(6 / segments),
          .progress_pieces = 4 + rng.below(6),
          .piece_length = rng.uniform(0.5, 1.5),
          .piece_duration = rng.uniform(0.15, 0.8) / segments,
          .curvature = rng.uniform(0.1, 1.2),
          .wait = 0.4};
}

Bent random_start(Rng& rng, double half) {
  return {{rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-3.14, 3.14)},
          rng.uniform(-0.5, 0.5)};
}

TEST(AgainstBruteForce, Limits) {
  const std::uint64_t seed = 11;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Rng rng(seed);
  for (int i = 0; i < kLimitPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    const traj::TeamTrajectory plan{{random_way(rng, random_start(rng, 5.0), random_shape(rng))}};
    const Extremes e = extremes_of(plan.robots[0], car().wheelbase, kRate);
    const auto judged = [&](double factor, int which) {
      world::Scenario scenario = scenario_for(plan, car(), 100.0);
      vehicle::Limits& limits = scenario.models[0].limits;
      const auto set = [&](int index, double& limit, double extreme) {
        if (which < 0 || which == index) limit = factor * extreme;
      };
      set(0, limits.speed, e.speed);
      set(1, limits.reverse_speed, e.reverse_speed);
      set(2, limits.acceleration, e.acceleration);
      set(3, limits.lateral_acceleration, e.lateral_acceleration);
      if (which < 0 || which == 4) limits.steering = std::atan(factor * e.curvature * car().wheelbase);
      set(5, limits.steering_rate, e.steering_rate);
      return certify(scenario, world::StaticMap(scenario), plan);
    };
    const Certificate clean = judged(1.0 + 1e-3, -1);
    EXPECT_TRUE(clean.holds) << summary(clean);
    const Kind kinds[] = {Kind::speed,        Kind::reverse_speed,
                          Kind::acceleration, Kind::lateral_acceleration,
                          Kind::curvature,    Kind::steering_rate};
    for (int which = 0; which < 6; ++which) {
      if ((which == 0 && e.speed < 0.1) || (which == 1 && e.reverse_speed < 0.1)) continue;
      const Certificate broken = judged(1.0 - 1e-5, which);
      EXPECT_TRUE(!broken.holds && breaks(broken, kinds[which], 0))
          << name_of(kinds[which]) << ": " << summary(broken);
      ASSERT_EQ(broken.violations.size(), 1u) << summary(broken);
      const double found = broken.violations.front().value, extreme = found / broken.violations.front().limit;
      EXPECT_NEAR(extreme, 1.0, 2e-3) << name_of(kinds[which]);
    }
  }
}

/// A few cars, polygons, discs and moving things, met at random: most overlap, which is as good a test as
/// not.
struct Meeting {
  world::Scenario scenario;
  traj::TeamTrajectory plan;
};

void add_obstacles(Rng& rng, world::Scenario& scenario) {
  for (int i = 0; i < 4; ++i) {
    std::vector<Vec2> polygon;
    const double radius = rng.uniform(0.1, 0.8), phase = rng.uniform(0.0, 2.0);
    const int corners = 3 + rng.below(3);
    for (int c = 0; c < corners; ++c) polygon.push_back(radius * geom::unit(phase + 6.28318 * c / corners));
    const geom::Pose2 at{rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(-3, 3)};
    world::Obstacle obstacle{.name = "", .shape = polygon, .motion = {}};
    if (rng.below(3) == 0) obstacle.shape = world::Circle{{0.1, 0.2}, radius};
    if (i < 2) {
      double t = rng.uniform(-1.0, 1.0);
      for (int leg = 0; leg < 3; ++leg, t += rng.uniform(0.5, 2.0)) {
        obstacle.motion.push_back({t, {rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(-3, 3)}});
      }
    } else if (auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
      circle->center = at.position();
    } else {
      for (Vec2& p : std::get<std::vector<Vec2>>(obstacle.shape)) p = at * p;
    }
    scenario.obstacles.push_back(obstacle);
  }
}

Meeting random_meeting(Rng& rng) {
  Meeting meeting;
  const int cars = 2 + rng.below(2);
  for (int k = 0; k < cars; ++k) {
    meeting.plan.robots.push_back(random_way(rng, random_start(rng, 4.0), random_shape(rng)));
  }
  meeting.scenario =
      scenario_for(meeting.plan, car(rng.uniform(0.4, 1.0), rng.uniform(0.2, 0.5)), rng.uniform(12, 16));
  add_obstacles(rng, meeting.scenario);
  return meeting;
}

TEST(AgainstBruteForce, Distances) {
  const std::uint64_t seed = 12;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Rng rng(seed);
  int clean = 0;
  for (int i = 0; i < kDistancePlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    Meeting meeting = random_meeting(rng);
    world::Scenario& scenario = meeting.scenario;
    const world::StaticMap map(scenario);
    double end = meeting.plan.makespan();
    for (const auto& o : scenario.obstacles) {
      if (!o.motion.empty()) end = std::max(end, o.motion.back().t);
    }
    const Distances found = least_distances(scenario, map, meeting.plan, 0.0, end, kRate);

    scenario.margins = {found.robots - 1e-3, found.obstacles() - 1e-3};
    const Certificate kept = certify(scenario, map, meeting.plan);
    EXPECT_TRUE(kept.holds) << summary(kept);
    EXPECT_LE(kept.robots.clearance, found.robots + kClosestResolution + 1e-4);
    EXPECT_GE(kept.robots.clearance, found.robots - 1e-3);
    if (found.obstacles() < kObstacleSearch) {
      EXPECT_LE(kept.obstacles.clearance, found.obstacles() + kClosestResolution + 1e-4);
      EXPECT_GE(kept.obstacles.clearance, found.obstacles() - 1e-3);
    }
    clean += found.robots > 0.0 && found.obstacles() > 0.0;

    scenario.margins = {found.robots + 2.5e-4, -100.0};
    const Certificate met = certify(scenario, map, meeting.plan);
    EXPECT_TRUE(!met.holds && breaks(met, Kind::robot_clearance)) << summary(met);
    const std::pair<Kind, double> sorts[] = {{Kind::obstacle_clearance, found.statics},
                                             {Kind::moving_obstacle_clearance, found.moving},
                                             {Kind::bounds, found.bounds}};
    for (const auto& [kind, distance] : sorts) {
      scenario.margins = {-100.0, distance + 2.5e-4};
      const Certificate touched = certify(scenario, map, meeting.plan);
      EXPECT_TRUE(!touched.holds && breaks(touched, kind)) << name_of(kind) << ": " << summary(touched);
    }
  }
  std::printf("%d of %d plans without overlap\n", clean, kDistancePlans);
}

TEST(Certificate, IsTheSameForAnyNumberOfThreads) {
  Rng rng(13);
  for (int i = 0; i < 20; ++i) {
    Meeting meeting = random_meeting(rng);
    meeting.scenario.margins = {0.05, 0.05};
    meeting.scenario.models[0].limits.speed = 1.0;
    const world::StaticMap map(meeting.scenario);
    const Certificate one = certify(meeting.scenario, map, meeting.plan, {.threads = 1, .deadline = {}});
    const Certificate four = certify(meeting.scenario, map, meeting.plan, {.threads = 4, .deadline = {}});
    EXPECT_EQ(summary(one), summary(four));
    EXPECT_EQ(one.robots.clearance, four.robots.clearance);
    EXPECT_EQ(one.robots.time, four.robots.time);
    EXPECT_EQ(one.obstacles.clearance, four.obstacles.clearance);
    EXPECT_EQ(one.obstacles.other, four.obstacles.other);
  }
}

}  // namespace
}  // namespace seine::certify::test
