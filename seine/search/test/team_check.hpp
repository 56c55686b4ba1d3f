#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/search/path.hpp"
#include "seine/search/traffic.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// An independent look at a team's motions: every pose on a grid of 1 cm of motion, exact distances, limits
/// of every car. It shares the path and profile evaluation with the guess, and nothing else.
class TeamCheck {
 public:
  TeamCheck(const world::Scenario& scenario, const std::vector<TimedPath>& motions)
      : scenario_(scenario), motions_(motions), map_(scenario) {}

  void run() {
    ASSERT_EQ(motions_.size(), scenario_.robots.size());
    for (std::size_t i = 0; i < motions_.size(); ++i) check_drive(i);
    double fastest = 0.0, latest = 0.0;
    for (const vehicle::Model& model : scenario_.models) fastest = std::max(fastest, model.limits.speed);
    for (const TimedPath& motion : motions_) latest = std::max(latest, motion.arrival());
    for (const world::Obstacle& obstacle : scenario_.obstacles)
      if (!obstacle.motion.empty()) latest = std::max(latest, obstacle.motion.back().t);
    for (double t = 0.0; t <= latest + 0.1 && !testing::Test::HasFailure(); t += 0.01 / fastest)
      check_instant(t);
  }

 private:
  // Between the samples everything moves a centimetre at most, towards each other two.
  static constexpr double kBetween = 1e-3, kRound = 1e-6;

  void check_drive(std::size_t i) {
    const TimedPath& motion = motions_[i];
    const world::Robot& robot = scenario_.robots[i];
    const vehicle::Limits& limits = scenario_.model_of(robot).limits;
    ASSERT_FALSE(motion.profile.empty());
    EXPECT_EQ(motion.profile.front().t, 0.0);
    EXPECT_NEAR(motion.profile.front().v, std::abs(robot.start_speed), kRound);
    EXPECT_EQ(motion.profile.back().v, 0.0);
    EXPECT_NEAR(motion.profile.back().s, motion.path.length(), kRound);
    const geom::Pose2 start = pose_at(motion.path, 0.0), goal = pose_at(motion.path, motion.path.length());
    EXPECT_LT(norm(start.position() - robot.start.position()), kRound);
    EXPECT_LT(norm(goal.position() - robot.goal->position()), kRound);
    EXPECT_LT(std::abs(geom::wrap_angle(goal.heading - robot.goal->heading)), kRound);
    for (std::size_t k = 1; k < motion.profile.size(); ++k) {
      const ProfileKnot &a = motion.profile[k - 1], &b = motion.profile[k];
      ASSERT_GT(b.t, a.t);
      EXPECT_NEAR(b.s - a.s, 0.5 * (a.v + b.v) * (b.t - a.t), kRound);  // constant acceleration
      EXPECT_LE(std::abs(b.v - a.v) / (b.t - a.t), limits.acceleration + kRound);
    }
    check_path(motion, scenario_.model_of(robot));
  }

  void check_path(const TimedPath& motion, const vehicle::Model& model) {
    const auto& points = motion.path.points;
    for (std::size_t p = 0; p + 1 < points.size(); ++p) {
      EXPECT_LE(std::abs(points[p].curvature), model.max_curvature() + kRound);
      if (points[p].gear == points[p + 1].gear) continue;
      const bool rests = std::any_of(motion.profile.begin(), motion.profile.end(), [&](const ProfileKnot& k) {
        return k.v == 0.0 && std::abs(k.s - points[p].s) < kRound;
      });
      EXPECT_TRUE(rests) << "gear change at speed, s = " << points[p].s;
    }
  }

  void check_instant(double t) {
    std::vector<std::vector<geom::Vec2>> here;
    std::vector<geom::Box> boxes;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const vehicle::Model& model = scenario_.model_of(scenario_.robots[i]);
      const ProfileKnot k = motions_[i].at(t);
      check_speed(motions_[i].path, k, model.limits);
      here.push_back(geom::placed({model.footprint, 0.0}, pose_at(motions_[i].path, k.s)).core);
      boxes.push_back(geom::bounding_box(here.back()).inflated(scenario_.margins.robot));
      EXPECT_TRUE(map_.clear(here.back(), scenario_.margins.obstacle - kBetween))
          << "robot " << i << " t " << t;
      check_moving(here.back(), t);
    }
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (boxes[i].overlaps(boxes[j])) {
          EXPECT_GE(geom::distance(here[i], here[j]), scenario_.margins.robot - kBetween)
              << "robots " << i << " and " << j << " t " << t;
        }
  }

  void check_speed(const Path& path, const ProfileKnot& k, const vehicle::Limits& limits) {
    const auto next = std::upper_bound(path.points.begin(), path.points.end(), k.s,
                                       [](double s, const PathPoint& p) { return s < p.s; });
    if (next == path.points.begin()) return;
    const PathPoint& point = *(next - 1);
    EXPECT_LE(k.v, (point.gear > 0 ? limits.speed : limits.reverse_speed) + kRound);
    EXPECT_LE(k.v * k.v * std::abs(point.curvature), limits.lateral_acceleration * (1.0 + 1e-9) + kRound);
  }

  void check_moving(const std::vector<geom::Vec2>& footprint, double t) {
    for (const MovingPart& part : moving_parts(scenario_)) {
      const geom::Convex there = geom::placed(part.shape, pose_at(part.motion, t));
      EXPECT_GE(geom::distance(footprint, there.core) - there.radius, scenario_.margins.obstacle - kBetween)
          << "t " << t;
    }
  }

  const world::Scenario& scenario_;
  const std::vector<TimedPath>& motions_;
  world::StaticMap map_;
};

}  // namespace seine::search
