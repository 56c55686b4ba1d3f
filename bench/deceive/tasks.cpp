// Random tasks of every family, and their plans.
#include "bench/deceive/mutants.hpp"
#include "seine/base/error.hpp"
#include "seine/planner/planner.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::deceive {

world::Scenario random_task(Rng& rng) {
  const std::uint64_t seed = rng.next() % 1'000'000;
  switch (rng.below(8)) {
    case 0:
      return world::generate(world::Family::random, 1 + rng.below(10), seed);
    case 1:
      return world::generate(world::Family::swap, 2 + rng.below(4), seed);
    case 2:
      return world::generate(world::Family::corridor, 2 + rng.below(4), seed);
    case 3:
      return world::generate(world::Family::parking, 1 + rng.below(3), seed);
    case 4: {
      constexpr int kTeams[] = {3, 4, 6};
      const auto cluttered = rng.below(2) == 0 ? world::Clutteredness::few : world::Clutteredness::dense;
      return world::throw_scene(kTeams[rng.below(3)], seed, cluttered);
    }
    case 5:
      return world::gap_scene(3 + rng.below(2), seed);
    default: {
      const auto kinds = world::all_everyday();
      const auto vehicles = vehicle::catalogue();
      const auto kind = kinds[static_cast<std::size_t>(rng.below(static_cast<int>(kinds.size())))];
      const auto& vehicle = vehicles[static_cast<std::size_t>(rng.below(static_cast<int>(vehicles.size())))];
      return world::everyday(kind, vehicle.model, seed);
    }
  }
}

std::optional<Case> certified_case(Rng& rng) {
  Case made{.name = "mutant", .scenario = random_task(rng), .plan = {}};
  try {
    planner::PlanResult result = planner::plan(made.scenario, {.deadline_s = 2.0, .threads = 1});
    if (!result.certified) return {};
    made.plan = std::move(result.plan);
  } catch (const Error&) {
    return {};
  }
  return made;
}

}  // namespace seine::deceive
