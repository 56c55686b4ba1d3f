// Maps are solid for the planner, too: what it certifies on random maps, turned and shifted, in any bounds,
// is held against a look at every cell (cells.hpp). SEINE_MAP_PLANS in the environment asks for
// another number of plans.
#include <gtest/gtest.h>

#include <cstdlib>

#include "seine/base/effort.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/check.hpp"
#include "tests/maps/cells.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 402;

int cases() {
  const char* wanted = std::getenv("SEINE_MAP_PLANS");
  return wanted != nullptr ? std::atoi(wanted) : effort(60, 6);
}

/// A car somewhere on a random map, with somewhere to go: as nearly anywhere as the scenario allows.
std::optional<world::Scenario> random_task(Rng& rng) {
  world::Scenario scenario;
  scenario.name = "random map";
  world::test::add_random_map(rng, scenario);
  const double size = rng.uniform(0.2, 0.7);
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(size, 0.6 * size, 0.2 * size);
  model.wheelbase = 0.6 * size;
  scenario.models = {model};
  scenario.margins = {0.02, 0.02};
  const world::StaticMap map(scenario);
  for (int tries = 0; tries < 100; ++tries) {
    const auto anywhere = [&] {
      return geom::Pose2{rng.uniform(scenario.bounds.low.x, scenario.bounds.high.x),
                         rng.uniform(scenario.bounds.low.y, scenario.bounds.high.y), rng.uniform(-3.1, 3.1)};
    };
    scenario.robots = {{.name = "car", .start = anywhere(), .goal = anywhere()}};
    if (world::check(scenario, map).empty()) return scenario;
  }
  return std::nullopt;
}

TEST(MapPlans, DriveThroughNothing) {
  int planned = 0, asked = 0;
  for (int i = 0; asked < cases(); ++i) {
    Rng rng(kSeed + static_cast<std::uint64_t>(i));
    const std::optional<world::Scenario> scenario = random_task(rng);
    if (!scenario) continue;
    ++asked;
    Options options;
    options.threads = 1;
    options.deadline_s = 0.5 * effort(1, 30);
    const PlanResult result = plan(*scenario, options);
    if (!result.certified) continue;
    ++planned;
    const traj::RobotTrajectory& way = result.plan.robots[0];
    const std::vector<Vec2>& body = scenario->models[0].footprint;
    std::vector<Vec2> placed(body.size());
    double least = 0.05;
    constexpr int kLooks = 500;
    for (int k = 0; k <= kLooks; ++k) {
      const geom::Pose2 pose = way.at(way.arrival() * k / kLooks).pose;
      for (std::size_t p = 0; p < body.size(); ++p) placed[p] = pose * body[p];
      least = std::min(least, world::test::cell_distance(*scenario, placed, 0.05));
    }
    // Beside corners the look at cells sees less than there is, but not nothing.
    EXPECT_GT(least, 0.0) << "seed " << kSeed + static_cast<std::uint64_t>(i);
  }
  RecordProperty("planned", planned);
  EXPECT_GT(planned, 0);  // how many are found in time is not the question
}

}  // namespace
}  // namespace seine::planner
