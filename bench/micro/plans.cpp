// A whole plan and its proof: random clutter by team size.
#include <benchmark/benchmark.h>

#include "seine/certify/certificate.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace {

using seine::planner::PlanResult;

void plan(benchmark::State& state) {
  const auto scenario =
      seine::world::generate(seine::world::Family::random, static_cast<int>(state.range(0)), 1);
  bool certified = true;
  for (auto _ : state)
    certified = seine::planner::plan(scenario, {.threads = 1, .progress = {}}).certified && certified;
  if (!certified) state.SkipWithError("not certified");
}
BENCHMARK(plan)->Arg(8)->Arg(26)->Unit(benchmark::kMillisecond);

void certificate(benchmark::State& state) {
  const auto scenario =
      seine::world::generate(seine::world::Family::random, static_cast<int>(state.range(0)), 1);
  const seine::world::StaticMap map(scenario);
  const PlanResult result = seine::planner::plan(scenario, {.threads = 1, .progress = {}});
  if (!result.certified) state.SkipWithError("not certified");
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        seine::certify::certify(scenario, map, result.plan, {.threads = 1, .deadline = {}}));
  }
}
BENCHMARK(certificate)->Arg(8)->Arg(26)->Unit(benchmark::kMillisecond);

}  // namespace
