// The tracker's quadratic programme, as it comes one after the other while a team drives.
#include <cstdio>
#include <vector>

#include "bench/drive/parts.hpp"
#include "bench/drive/statistics.hpp"
#include "seine/base/rng.hpp"
#include "seine/mpc/tracker.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/families.hpp"

namespace seine::bench {
namespace {

// Drives one car along its way with errors in what it knows, so that no programme is like the last.
void drive_timed(const vehicle::Model& model, const traj::RobotTrajectory& way, double lag, Rng& rng,
                 std::vector<double>& steps) {
  mpc::Tracker tracker(model, {.lag = lag});
  const traj::State start = way.at(0.0);
  mpc::State state{start.pose.x, start.pose.y, start.pose.heading, start.speed};
  for (double t = 0.0; t < way.arrival(); t += tracker.options().period) {
    mpc::State measured = state;
    measured.x += 0.01 * rng.normal(), measured.y += 0.01 * rng.normal();
    measured.heading += 0.005 * rng.normal(), measured.speed += 0.02 * rng.normal();
    const double begin = cpu_seconds();
    const mpc::Command command = tracker.step(measured, way, t);
    if (t > 0.0) steps.push_back(1e3 * (cpu_seconds() - begin));
    state = mpc::advance(state, command.input, model.wheelbase, tracker.options().period);
  }
}

}  // namespace

void programmes(int runs) {
  std::printf(
      "a tracker's step, warm: linearise, set up, solve; ms      median     99 %%    worst    steps\n");
  for (const double lag : {0.0, 0.1}) {
    Rng rng(1);
    std::vector<double> steps;
    for (int seed = 0; seed < runs; ++seed) {
      progress("programmes", seed, runs);
      const world::Scenario scenario =
          world::generate(world::Family::random, 8, static_cast<std::uint64_t>(seed));
      const planner::PlanResult plan = planner::plan(scenario);
      for (std::size_t k = 0; plan.certified && k < plan.plan.robots.size(); ++k)
        drive_timed(scenario.model_of(scenario.robots[k]), plan.plan.robots[k], lag, rng, steps);
    }
    progress("programmes", runs, runs);
    std::printf("  horizon 20, lag %.1f s                                %8.3f %8.3f %8.3f %8zu\n", lag,
                quantile(steps, 0.5), quantile(steps, 0.99), quantile(steps, 1.0), steps.size());
    std::fflush(stdout);
  }
}

}  // namespace seine::bench
