// How often a team with a net gets a new plan while it drives, and how fast the simulation is.
#include <cstdio>
#include <vector>

#include "bench/drive/parts.hpp"
#include "bench/drive/statistics.hpp"
#include "bench/drive/tasks.hpp"
#include "seine/drive/replanner.hpp"

namespace seine::bench {
namespace {

struct Answers {
  std::vector<double> seconds;
  int certified = 0;
};

// The replanner, timed: CPU time of its one thread.
sim::Replanner watched(Answers& answers) {
  return [&answers, plan = drive::replanner()](const sim::Situation& situation) {
    const double begin = cpu_seconds();
    sim::Replanned answer = plan(situation);
    answers.seconds.push_back(cpu_seconds() - begin);
    answers.certified += answer.certified ? 1 : 0;
    return answer;
  };
}

}  // namespace

void replanning(int runs) {
  std::printf(
      "replanning, noise low    plans   certified   late   ms: median    90 %%    99 %%  slowest   Hz\n");
  for (const int robots : {3, 4, 6}) {
    Answers answers;
    int late = 0;
    for (const Planned& task : certified_throws(robots, runs))
      late += drive(task, {.noise = sim::noise_named("low"), .replanner = watched(answers)}).replans_late;
    double sum = 0.0;
    for (const double s : answers.seconds) sum += s;
    const auto ms = [&](double part) { return 1e3 * quantile(answers.seconds, part); };
    const auto count = static_cast<double>(answers.seconds.size());
    std::printf("  %d cars                %6zu     %5.1f %% %6d       %6.1f  %6.1f  %6.1f   %6.1f  %5.1f\n",
                robots, answers.seconds.size(), 100.0 * answers.certified / count, late, ms(0.5), ms(0.9),
                ms(0.99), ms(1.0), count / sum);
    std::fflush(stdout);
  }
}

void speed(int runs) {
  std::vector<double> factor;
  for (const Planned& task : certified_throws(4, runs)) {
    const double begin = cpu_seconds();
    const double simulated = drive(task, {.noise = sim::noise_named("low")}).duration;
    factor.push_back(simulated / (cpu_seconds() - begin));
  }
  std::printf("simulation of a catch with 4 cars, one core: %.1f times real time (median), %.1f at least\n",
              quantile(factor, 0.5), quantile(factor, 0.0));
}

}  // namespace seine::bench
