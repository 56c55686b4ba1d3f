// Maps are solid: random maps, turned and shifted, in any bounds, and random drives on them, against a look
// at every cell (cells.hpp). SEINE_MAP_CASES in the environment asks for another number of cases.
#include <gtest/gtest.h>

#include <cstdlib>

#include "seine/base/effort.hpp"
#include "seine/certify/certificate.hpp"
#include "seine/certify/test/plans.hpp"
#include "tests/maps/cells.hpp"

namespace seine::certify::test {
namespace {

constexpr std::uint64_t kSeed = 911;
constexpr double kCap = 0.05;  // m, how far away things are looked at

int cases() {
  const char* wanted = std::getenv("SEINE_MAP_CASES");
  return wanted != nullptr ? std::atoi(wanted) : effort(3000, 150);
}

/// The least distance of a drive to cells and to the bounds, on a grid of times.
double least_distance(const world::Scenario& scenario, const traj::RobotTrajectory& way) {
  const std::vector<Vec2>& body = scenario.models[0].footprint;
  std::vector<Vec2> placed(body.size());
  double least = kCap;
  constexpr int kSteps = 300;
  for (int i = 0; i <= kSteps; ++i) {
    const geom::Pose2 pose = way.at(way.arrival() * i / kSteps).pose;
    for (std::size_t k = 0; k < body.size(); ++k) placed[k] = pose * body[k];
    least = std::min(least, world::test::cell_distance(scenario, placed, kCap));
    for (const Vec2 p : placed) {
      const geom::Box& b = scenario.bounds;
      least = std::min({least, p.x - b.low.x, p.y - b.low.y, b.high.x - p.x, b.high.y - p.y});
    }
  }
  return least;
}

traj::RobotTrajectory random_drive(Rng& rng, const geom::Box& bounds) {
  const Vec2 at{rng.uniform(bounds.low.x, bounds.high.x), rng.uniform(bounds.low.y, bounds.high.y)};
  const geom::Pose2 start{at.x, at.y, rng.uniform(-3.1, 3.1)};
  if (rng.below(8) == 0) return parked(start);
  return random_way(rng, {start, 0.0},
                    {.segments = 1 + rng.below(2),
                     .curve_pieces = 1 + rng.below(4),
                     .progress_pieces = 4,
                     .piece_length = rng.uniform(0.3, 1.0)});
}

TEST(Map, IsSolid) {
  const int wanted = cases();
  int driven_through = 0, clear = 0;
  for (int i = 0; i < wanted; ++i) {
    Rng rng(kSeed + static_cast<std::uint64_t>(i));
    world::Scenario scenario;
    world::test::add_random_map(rng, scenario);
    traj::TeamTrajectory plan{{random_drive(rng, scenario.bounds)}};
    const double size = rng.uniform(0.15, 0.8);
    world::Scenario asked = scenario_for(plan, car(size, 0.6 * size), 1.0);
    asked.bounds = scenario.bounds, asked.map = scenario.map, asked.outside_free = scenario.outside_free;
    const double least = least_distance(asked, plan.robots[0]);
    const bool holds = certify(asked, world::StaticMap(asked), plan).holds;
    if (least < -5e-4) {
      ++driven_through;
      EXPECT_FALSE(holds) << "seed " << kSeed + static_cast<std::uint64_t>(i) << ": overlaps by " << -least;
    } else if (least >= kCap) {  // more than what is driven between two looks
      ++clear;
      EXPECT_TRUE(holds) << "seed " << kSeed + static_cast<std::uint64_t>(i);
    }
  }
  RecordProperty("driven_through", driven_through);
  EXPECT_GT(driven_through, wanted / 4);
  EXPECT_GT(clear, wanted / 20);
}

}  // namespace
}  // namespace seine::certify::test
