#include "bench/drive/tasks.hpp"

#include <utility>

#include "bench/drive/statistics.hpp"
#include "seine/drive/tracking.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/net_families.hpp"

namespace seine::bench {

std::vector<Planned> certified_throws(int robots, int count) {
  constexpr double kDeadline = 20.0;  // s
  std::vector<Planned> all;
  for (std::uint64_t seed = 0; static_cast<int>(all.size()) < count; ++seed) {
    Planned planned{seed, world::throw_scene(robots, seed), {}};
    planner::PlanResult result = planner::plan(planned.scenario, {.deadline_s = kDeadline});
    if (!result.certified) continue;
    planned.plan = std::move(result.plan);
    all.push_back(std::move(planned));
    progress("planning", static_cast<int>(all.size()), count);
  }
  return all;
}

sim::SimulationResult drive(const Planned& task, sim::SimulationOptions options) {
  options.seed = task.seed;
  return sim::simulate(task.scenario, task.plan,
                       drive::tracking_controller(task.scenario, drive::tracking_options(options.noise)),
                       options);
}

}  // namespace seine::bench
