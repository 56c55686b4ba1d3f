// What every room above stands on: exact distances, queries of the map.
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/convex.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/families.hpp"
#include "seine/world/static_map.hpp"

namespace {

using seine::Rng;
using seine::geom::Pose2;
using seine::geom::Vec2;

constexpr std::size_t kCases =
    1024;  // enough that no branch is learnt by heart, few enough to stay in the cache

Pose2 random_pose(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-3.14, 3.14)};
}

using Quad = std::array<Vec2, 4>;

Quad random_car(Rng& rng, double reach) {
  const std::vector<Vec2> body = seine::vehicle::rectangle_footprint(0.60, 0.40, 0.10);
  Quad car{};
  seine::geom::place(body, random_pose(rng, reach), car);
  return car;
}

void distance_of_two_cars(benchmark::State& state) {
  Rng rng(1);
  std::vector<Quad> cars;
  for (std::size_t i = 0; i < kCases; ++i) cars.push_back(random_car(rng, 1.0));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(seine::geom::distance(cars[i % kCases], cars[(i * 7 + 1) % kCases]));
    ++i;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(distance_of_two_cars);

void map_is_clear(benchmark::State& state) {
  const seine::world::Scenario scenario = seine::world::generate(seine::world::Family::random, 26, 1);
  const seine::world::StaticMap map(scenario);
  Rng rng(2);
  std::vector<Quad> cars;
  for (std::size_t i = 0; i < kCases; ++i) {
    cars.push_back(random_car(rng, 9.0));
    for (Vec2& corner : cars.back()) corner += Vec2{10.0, 10.0};
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(map.clear(cars[i++ % kCases], 0.05));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(map_is_clear);

}  // namespace
