#include "seine/world/flight_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/flight.hpp"

namespace seine::world {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 77;

// Of a point from a rectangle about the origin; 0 inside.
double beside(Vec2 p, double half_length, double half_width) {
  return std::hypot(std::max(0.0, std::abs(p.x) - half_length), std::max(0.0, std::abs(p.y) - half_width));
}

TEST(FlightPath, AgreesWithALookAtEveryTenthOfAMillisecond) {
  Rng rng(kSeed);
  int hit = 0, free = 0;
  const int cases = effort(300, 40);
  for (int i = 0; i < cases; ++i) {
    net::Target target;
    target.position = {rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(1, 3)};
    target.velocity = {rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(-1, 6)};
    target.drag = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 1.0);
    target.radius = rng.uniform(0.03, 0.3);
    const double half_length = rng.uniform(0.05, 1.0), half_width = rng.uniform(0.05, 0.5);
    const double height = rng.uniform(0.5, 3.5);
    const geom::Pose2 from{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-1, 1)};
    const geom::Pose2 to{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-1, 1)};
    Scenario scenario;
    scenario.obstacles.push_back({.name = "gate",
                                  .shape = std::vector<Vec2>{{-half_length, -half_width},
                                                             {half_length, -half_width},
                                                             {half_length, half_width},
                                                             {-half_length, half_width}},
                                  .height = height,
                                  .motion = {{0.2, from}, {0.8, to}}});
    const net::Flight flight(target);
    const auto crossing = flight.crossing(0.4);
    ASSERT_TRUE(crossing);
    const double until = crossing->state.time;
    double least = 1e9, first = 1e9;
    bool out = false;
    for (double t = 0.0; t <= until; t += 1e-4) {
      const double share = std::clamp((t - 0.2) / 0.6, 0.0, 1.0);
      const double heading = from.heading + share * (to.heading - from.heading);
      const geom::Vec3 p = flight.at(t).position;
      const Vec2 d{p.x - from.x - share * (to.x - from.x), p.y - from.y - share * (to.y - from.y)};
      const Vec2 local{std::cos(heading) * d.x + std::sin(heading) * d.y,
                       std::cos(heading) * d.y - std::sin(heading) * d.x};
      const double gap = std::hypot(beside(local, half_length, half_width), std::max(0.0, p.z - height));
      out = out || gap > target.radius + 1e-4;
      if (!out) continue;
      least = std::min(least, gap - target.radius);
      if (gap < target.radius) first = std::min(first, t);
    }
    const auto found = flight_obstruction(scenario, target, until);
    SCOPED_TRACE("seed 77, case " + std::to_string(i));
    if (least < 0.0) {
      ++hit;
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->time, first, 2e-3);
    } else if (least > 3e-3) {
      ++free;
      EXPECT_FALSE(found) << found->time;
    }
    scenario.obstacles[0].height = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(flight_obstruction(scenario, target, until));
  }
  EXPECT_GT(hit, cases / 50);
  EXPECT_GT(free, cases / 20);
}

}  // namespace
}  // namespace seine::world
