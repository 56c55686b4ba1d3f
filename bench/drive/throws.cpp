// Throws that the planner certifies, driven and caught in the physics.
#include <cstdio>
#include <string>
#include <vector>

#include "bench/drive/parts.hpp"
#include "bench/drive/statistics.hpp"
#include "bench/drive/tasks.hpp"
#include "seine/drive/replanner.hpp"

namespace seine::bench {
namespace {

void tell(const Planned& task, const sim::SimulationResult& result) {
  std::printf(
      "    seed %llu: %s%s, goal %.3f m, tracking %.3f m, stretch %.3f, %d of %d plans taken, %d late\n",
      static_cast<unsigned long long>(task.seed), sim::name_of(result.outcomes.front().fate),
      result.stopped ? ", stopped" : "", result.goal_error, result.tracking_rms, result.worst_stretch,
      result.replans, result.replans_asked, result.replans_late);
  for (const sim::Note& note : result.notes) std::printf("        %.2f s %s\n", note.time, note.text.c_str());
}

}  // namespace

void throws(int runs) {
  std::printf(
      "throws with replanning  caught  delivered  of   plans taken  asked  late  RMS m   x real time\n");
  for (const int robots : {3, 4, 6}) {
    const std::vector<Planned> tasks = certified_throws(robots, runs);
    for (const char* name : {"none", "low", "high"}) {
      const sim::Noise noise = sim::noise_named(name);
      int caught = 0, delivered = 0, taken = 0, asked = 0, late = 0;
      std::vector<double> error, factor;
      for (const Planned& task : tasks) {
        const sim::SimulationResult result = drive(task, {.noise = noise, .replanner = drive::replanner()});
        caught += result.caught, delivered += result.delivered;
        taken += result.replans, asked += result.replans_asked, late += result.replans_late;
        error.push_back(result.tracking_rms), factor.push_back(result.real_time_factor);
        if (!result.caught || !result.delivered) tell(task, result);
        progress(name, static_cast<int>(error.size()), runs);
      }
      std::printf("%d cars, noise %-5s     %6d %10d  %d  %11d %6d %5d  %.4f  %5.1f\n", robots, name, caught,
                  delivered, runs, taken, asked, late, quantile(error, 0.5), quantile(factor, 0.5));
      std::fflush(stdout);
    }
  }
}

}  // namespace seine::bench
