// Teams of `random` that drive their plans: tracking errors and collisions.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/drive/parts.hpp"
#include "bench/drive/statistics.hpp"
#include "seine/drive/tracking.hpp"
#include "seine/planner/planner.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/world/families.hpp"

namespace seine::bench {
namespace {

constexpr int kTeam = 8;
constexpr double kDeadline = 20.0;  // s

struct Driven {
  std::uint64_t seed;
  sim::SimulationResult result;
};

std::vector<Driven> drive_all(const char* noise_name, int runs, int* planned) {
  const sim::Noise noise = sim::noise_named(noise_name);
  std::vector<Driven> all;
  for (int i = 0; i < runs; ++i) {
    progress(noise_name, i, runs);
    const auto seed = static_cast<std::uint64_t>(i);
    const world::Scenario scenario = world::generate(world::Family::random, kTeam, seed);
    const planner::PlanResult plan = planner::plan(scenario, {.deadline_s = kDeadline});
    if (!plan.certified) continue;
    ++*planned;
    const sim::Controller controller = drive::tracking_controller(scenario, drive::tracking_options(noise));
    all.push_back({seed, sim::simulate(scenario, plan.plan, controller, {.noise = noise, .seed = seed})});
  }
  progress(noise_name, runs, runs);
  return all;
}

}  // namespace

void tracking(int runs) {
  std::printf("tracking of random, %d cars: RMS of all, worst team, worst moment, m\n", kTeam);
  for (const char* noise : {"none", "low", "high"}) {
    int planned = 0;
    double squares = 0.0, worst_team = 0.0, worst = 0.0;
    const std::vector<Driven> all = drive_all(noise, runs, &planned);
    for (const Driven& driven : all) {
      squares += driven.result.tracking_rms * driven.result.tracking_rms / static_cast<double>(all.size());
      worst_team = std::max(worst_team, driven.result.tracking_rms);
      worst = std::max(worst, driven.result.tracking_worst);
      if (!driven.result.delivered)
        std::printf("    seed %llu did not arrive: %.3f m off\n",
                    static_cast<unsigned long long>(driven.seed), driven.result.goal_error);
    }
    std::printf("  noise %-5s %8.4f %8.4f %8.4f   (%d of %d planned)\n", noise, std::sqrt(squares),
                worst_team, worst, planned, runs);
    std::fflush(stdout);
  }
}

void collisions(int runs) {
  int planned = 0, hit = 0;
  double least = 1e9;
  for (const Driven& driven : drive_all("low", runs, &planned)) {
    least = std::min(least, driven.result.min_clearance);
    if (driven.result.min_clearance > 0.0) continue;
    ++hit;
    std::printf("    seed %llu: %.3f m\n", static_cast<unsigned long long>(driven.seed),
                driven.result.min_clearance);
  }
  std::printf("collisions of random, %d cars, noise low: %d in %d runs; closest %.3f m\n", kTeam, hit,
              planned, least);
}

}  // namespace seine::bench
