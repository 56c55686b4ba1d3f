#include "seine/search/velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "seine/base/rng.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

struct Leg {
  double length, curvature;
  int gear;
};

Path path_of(const std::vector<Leg>& legs) {
  Path path;
  geom::Pose2 pose{1.0, 2.0, 0.3};
  double s = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (i > 0 && legs[i].gear != legs[i - 1].gear)
      path.points.push_back({s, pose, legs[i - 1].curvature, legs[i - 1].gear});
    const int steps = static_cast<int>(std::ceil(legs[i].length / 0.04));
    for (int k = 0; k < steps; ++k) {
      path.points.push_back({s, pose, legs[i].curvature, legs[i].gear});
      pose = vehicle::drive(pose, legs[i].curvature, legs[i].gear * legs[i].length / steps);
      s += legs[i].length / steps;
    }
  }
  path.points.push_back({s, pose, legs.back().curvature, legs.back().gear});
  return path;
}

std::vector<Leg> random_legs(Rng& rng) {
  std::vector<Leg> legs;
  for (int i = 0, count = 1 + rng.below(5); i < count; ++i)
    legs.push_back({rng.uniform(0.02, 2.5), rng.below(3) == 0 ? 0.0 : rng.uniform(-2.1, 2.1),
                    rng.below(3) == 0 ? -1 : 1});
  return legs;
}

VelocityPlan plan_alone(const SpeedLattice& lattice) {
  VelocityWorkspace workspace;
  workspace.occupied.reset(lattice, 1);
  return plan_velocity(lattice, workspace, {.ticks = 4000});
}

TEST(Velocity, AloneOnAStraightItIsTheTrapezoid) {
  const vehicle::Model car = world::standard_car();
  const SpeedGrid grid = speed_grid(car);
  for (const double length : {0.3, 1.0, 4.0, 12.0}) {
    const SpeedLattice lattice(path_of({{length, 0.0, 1}}), grid, SweptFootprint(car.footprint));
    const VelocityPlan plan = plan_alone(lattice);
    ASSERT_TRUE(plan.found);
    const double v = grid.speed, a = grid.acceleration;
    const double best = length < v * v / a ? 2.0 * std::sqrt(length / a) : length / v + v / a;
    EXPECT_GE(plan.arrival, best - 1e-9);
    EXPECT_LE(plan.arrival, best + 2.0 * grid.step + 0.01 * best);
  }
}

// Limits in continuous time, on paths with bends and gear changes, also from a moving start.
TEST(Velocity, KeepsTheLimitsBetweenTheSamples) {
  vehicle::Model car = world::standard_car();
  car.limits.reverse_speed = 0.9;
  const SpeedGrid grid = speed_grid(car);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    std::vector<Leg> legs = random_legs(rng);
    double start_speed = 0.0;
    if (seed % 3 == 0) {
      legs.insert(legs.begin(), {rng.uniform(1.5, 3.0), 0.0, legs.front().gear});
      start_speed =
          legs.front().gear * rng.uniform(0.0, legs.front().gear > 0 ? grid.speed : grid.reverse_speed);
    }
    const Path path = path_of(legs);
    const SpeedLattice lattice(path, grid, SweptFootprint(car.footprint), start_speed);
    if (start_speed != 0.0 && !lattice.drivable()) continue;
    const VelocityPlan plan = plan_alone(lattice);
    ASSERT_TRUE(plan.found);
    const TimedPath timed{path, plan.profile};
    EXPECT_NEAR(timed.at(0.0).v, std::abs(start_speed), 1e-9);
    for (std::size_t k = 1; k < plan.profile.size(); ++k) {
      const ProfileKnot &a = plan.profile[k - 1], &b = plan.profile[k];
      EXPECT_NEAR(b.s - a.s, 0.5 * (a.v + b.v) * (b.t - a.t), 1e-9);
      EXPECT_LE(std::abs(b.v - a.v),
                grid.acceleration * (b.t - a.t) * (start_speed != 0.0 && k == 1 ? 1.2 : 1.0) + 1e-9);
    }
    for (double t = 0.0; t < plan.arrival; t += 0.003) {
      const ProfileKnot k = timed.at(t);
      std::size_t p = 0;
      while (p + 1 < path.points.size() && path.points[p + 1].s <= k.s) ++p;
      if (start_speed != 0.0) continue;  // it may begin faster than the reduced limits
      EXPECT_LE(k.v, (path.points[p].gear > 0 ? grid.speed : grid.reverse_speed) + 1e-9);
      EXPECT_LE(k.v * k.v * std::abs(path.points[p].curvature), grid.lateral + 1e-9);
    }
    for (std::size_t p = 0; p + 1 < path.points.size(); ++p) {
      if (path.points[p].gear == path.points[p + 1].gear) continue;
      double slowest = 1.0;
      for (const ProfileKnot& k : plan.profile)
        if (std::abs(k.s - path.points[p].s) < 1e-9) slowest = std::min(slowest, k.v);
      EXPECT_EQ(slowest, 0.0);
    }
  }
}

// The same states one by one, from the definition of the moves.
int earliest_by_sets(const SpeedLattice& lattice, const std::vector<Mark>& marks, int horizon) {
  const auto taken = [&](int tick, int unit) {
    return std::any_of(marks.begin(), marks.end(), [&](const Mark& m) {
      return m.begin <= tick && tick < m.end && m.first <= unit && unit <= m.last;
    });
  };
  int goal_free = 0;
  for (const Mark& m : marks)
    if (m.first <= lattice.units() && lattice.units() <= m.last) goal_free = std::max(goal_free, m.end);
  std::set<std::pair<int, int>> states{{0, 0}};
  if (taken(0, 0)) return -1;
  for (int layer = 0; 2 * layer <= horizon; ++layer) {
    if (states.contains({lattice.units(), 0}) && 2 * layer >= goal_free) return layer;
    std::set<std::pair<int, int>> next;
    for (const auto& [unit, level] : states)
      for (int j = -1; j <= 1; ++j) {
        if (level + j < 0 || level + j > lattice.grid().levels) continue;
        if ((lattice.moves(level, j)[unit / 64] >> (unit % 64) & 1) == 0) continue;
        const int middle = level == 0 && j == 1 ? 1 : level == 1 && j == -1 ? 0 : level;
        if (taken(2 * layer + 1, unit + middle) || taken(2 * layer + 2, unit + 2 * level + j)) continue;
        next.insert({unit + 2 * level + j, level + j});
      }
    states = std::move(next);
  }
  return -1;
}

TEST(Velocity, BitsAgreeWithSets) {
  const vehicle::Model car = world::standard_car();
  const SpeedGrid grid = speed_grid(car);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(1000 + seed);
    const SpeedLattice lattice(path_of(random_legs(rng)), grid, SweptFootprint(car.footprint));
    std::vector<Mark> marks;
    for (int i = 0, count = rng.below(12); i < count; ++i) {
      const int begin = rng.below(80), first = rng.below(lattice.units() + 1);
      marks.push_back(
          {begin, begin + 1 + rng.below(60), first, std::min(lattice.units(), first + rng.below(40))});
    }
    int ticks = 1;
    for (const Mark& mark : marks) ticks = std::max(ticks, mark.end + 1);
    VelocityWorkspace workspace;
    workspace.occupied.reset(lattice, ticks);
    workspace.occupied.add(marks);
    workspace.occupied.finish();
    constexpr int kHorizon = 400;
    const VelocityPlan plan = plan_velocity(lattice, workspace, {.ticks = kHorizon});
    const int layer = earliest_by_sets(lattice, marks, kHorizon);
    ASSERT_EQ(plan.found, layer >= 0);
    if (!plan.found) continue;
    ++found;
    EXPECT_NEAR(plan.arrival, layer * grid.step, 1e-9);
    for (std::size_t q = 0; q < plan.tested.size(); ++q)
      for (const Mark& m : marks)
        EXPECT_FALSE(m.begin <= static_cast<int>(q) && static_cast<int>(q) < m.end &&
                     m.first <= plan.tested[q] && plan.tested[q] <= m.last);
  }
  EXPECT_GT(found, 60);
}

// A car that leaves as late as possible waits at its start, not half way.
TEST(Velocity, WaitsAtTheStart) {
  const vehicle::Model car = world::standard_car();
  const SpeedGrid grid = speed_grid(car);
  const SpeedLattice lattice(path_of({{8.0, 0.0, 1}}), grid, SweptFootprint(car.footprint));
  VelocityWorkspace workspace;
  workspace.occupied.reset(lattice, 102);
  workspace.occupied.add(std::vector<Mark>{{0, 100, lattice.units() / 2, lattice.units() / 2 + 30}});
  workspace.occupied.finish();
  const VelocityPlan plan = plan_velocity(lattice, workspace, {.ticks = 400});
  ASSERT_TRUE(plan.found);
  EXPECT_EQ(plan.profile[1].s, 0.0);
  EXPECT_GT(plan.profile[1].t, 2.0);
}

TEST(MovingBody, ContainsTheCarBetweenTheTicks) {
  const vehicle::Model car = world::standard_car();
  const SpeedGrid grid = speed_grid(car);
  const SweptFootprint footprint(car.footprint);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(2000 + seed);
    const Path path = path_of(random_legs(rng));
    const SpeedLattice lattice(path, grid, footprint);
    const VelocityPlan plan = plan_alone(lattice);
    const double tick = rng.uniform(0.02, 0.1);
    const MovingBody body(path, plan.profile, footprint, tick);
    const TimedPath timed{path, plan.profile};
    for (double t = 0.0; t < plan.arrival + 1.0; t += 0.007) {
      const int q = static_cast<int>(std::lround(t / tick));
      int e = 0;
      while (body.events()[static_cast<std::size_t>(e)].end <= q) ++e;
      const std::span<const geom::Vec2> cover = body.polygon(e);
      for (const geom::Vec2 corner : geom::placed({car.footprint, 0.0}, pose_at(path, timed.at(t).s)).core)
        for (std::size_t i = 0; i < cover.size(); ++i) {
          const geom::Vec2 edge = cover[(i + 1) % cover.size()] - cover[i];
          ASSERT_GE(cross(edge, corner - cover[i]) / norm(edge), -5e-4) << "t " << t;
        }
    }
  }
}

}  // namespace
}  // namespace seine::search
