// One path and what it is made of: Reeds-Shepp words, sweeps of a footprint, whole plans from a planner that
// knows the map or not.
#include <benchmark/benchmark.h>

#include "seine/base/rng.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/reeds_shepp.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace {

using namespace seine;

void reeds_shepp(benchmark::State& state) {
  Rng rng(1);
  std::vector<geom::Pose2> poses;
  for (int i = 0; i < 1024; ++i)
    poses.push_back({rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-3, 3)});
  std::array<vehicle::ReedsSheppPath, 4> words;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& to = poses[++i % poses.size()];
    benchmark::DoNotOptimize(vehicle::reeds_shepp({}, to, 0.52, {.reverse = 1.5, .gear_change = 1.0}, words));
  }
}
BENCHMARK(reeds_shepp);

/// Time of one path, by family; the planner of the scene keeps what it learnt when `warm`.
void paths(benchmark::State& state, world::Family family, bool warm) {
  const auto scenario = world::generate(family, 26, 1);
  const world::StaticMap map(scenario);
  search::PathOptions options;
  options.clearance = scenario.margins.obstacle;
  const search::PathPlanner known(map, scenario.models[0]);
  for (auto _ : state) {
    const search::PathPlanner fresh(map, scenario.models[0]);
    for (const auto& robot : scenario.robots) {
      benchmark::DoNotOptimize((warm ? known : fresh).plan(robot.start, *robot.goal, options));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scenario.robots.size()));
}
BENCHMARK_CAPTURE(paths, random, world::Family::random, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paths, random_again, world::Family::random, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paths, corridor, world::Family::corridor, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paths, parking, world::Family::parking, false)->Unit(benchmark::kMillisecond);

}  // namespace
