// The letter's own planner beside Seine on the same tasks: ./dev bench letter-own. Both with one thread, and
// timed by the CPU's clock, so that other work on the machine does not count.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "bench/letter/tally.hpp"
#include "seine/baseline/letter/letter.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::bench {
namespace {

using Make = std::function<world::Scenario(std::uint64_t)>;
using Plan = std::function<planner::PlanResult(const world::Scenario&)>;

constexpr double kDeadline = 60.0;  // s

Plan letters(planner::Ablation without = {}, double cusp_speed = baseline::letter::Settings{}.cusp_speed) {
  return [=](const world::Scenario& scenario) {
    baseline::letter::Settings settings;
    settings.cusp_speed = cusp_speed;
    return baseline::letter::plan(scenario, {.deadline_s = kDeadline, .threads = 1, .without = without},
                                  settings);
  };
}

planner::PlanResult ours(const world::Scenario& scenario) {
  return planner::plan(scenario, {.deadline_s = kDeadline, .threads = 1});
}

void run(const std::string& name, int cases, const Make& make, const Plan& plan, bool broken) {
  Tally tally;
  const bool watched = isatty(STDERR_FILENO) != 0;
  for (int seed = 0; seed < cases; ++seed) {
    if (watched) std::fprintf(stderr, "\r%-40s %3d of %3d ", name.c_str(), seed + 1, cases);
    const world::Scenario scenario = make(static_cast<std::uint64_t>(seed));
    const std::clock_t begin = std::clock();
    const planner::PlanResult result = plan(scenario);
    tally.add(result, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  if (watched) std::fprintf(stderr, "\r%60s\r", "");
  tally.print(name);
  tally.print_catches();
  if (broken) tally.print_broken();
}

/// The letter's Table: its own arena, car and limits are not known [Pei24].
struct Printed {
  int robots;
  double compute, mean_travel, longest, distance, acceleration_cost;
};
constexpr Printed kPrinted[] = {{8, 0.280, 5.956, 6.918, 84.461, 244.925},
                                {14, 0.707, 6.067, 6.841, 145.002, 205.204},
                                {20, 1.186, 6.328, 7.151, 207.469, 196.532},
                                {26, 1.900, 6.387, 8.216, 271.725, 218.752}};

void random_clutter(int cases) {
  for (const int obstacles : {8, 20})
    for (const Printed& row : kPrinted) {
      const Make make = [&](std::uint64_t seed) {
        return world::generate(world::Family::random, row.robots, seed, {.obstacles = obstacles});
      };
      const std::string name = std::to_string(row.robots) + " cars, " + std::to_string(obstacles) + " obst.";
      run(name + ": letter", cases, make, letters(), true);
      run(name + ": Seine", cases, make, ours, false);
      if (obstacles == 8)
        std::printf("%-26s   100     100                %6.3f                   %7.2f  %7.2f  %8.1f %8.1f\n",
                    "  as printed", row.compute, row.mean_travel, row.longest, row.distance,
                    row.acceleration_cost);
    }
}

void throws(int cases) {
  for (const int robots : {3, 4, 6}) {
    const Make make = [&](std::uint64_t seed) { return world::throw_scene(robots, seed); };
    const std::string name = "throw, " + std::to_string(robots) + " cars";
    run(name + ": letter", cases, make, letters(), true);
    run(name + ", no catch", cases, make, letters({.catching = true}), true);
    run(name + ", no size", cases, make, letters({.size = true}), true);
    run(name + ": Seine", cases, make, ours, false);
  }
}

void cusp_speeds(int cases) {
  for (const double speed : {0.24, 0.1, 0.05}) {
    char name[64];
    std::snprintf(name, sizeof name, "14 cars, cusp at %.2f m/s", speed);
    run(
        name, cases,
        [](std::uint64_t seed) { return world::generate(world::Family::random, 14, seed, {.obstacles = 8}); },
        letters({}, speed), true);
  }
}

}  // namespace
}  // namespace seine::bench

int main(int count, char** arguments) {
  const int cases = count > 1 ? std::atoi(arguments[1]) : 20;
  const std::string only = count > 2 ? arguments[2] : "";
  const bool known = only.empty() || only == "random" || only == "throw" || only == "cusp";
  if (count > 3 || cases < 1 || !known) {
    std::fprintf(stderr, "usage: seine_letter_bench [CASES [random|throw|cusp]]\n");
    return 2;
  }
  seine::bench::Tally::print_head();
  if (only.empty() || only == "random") seine::bench::random_clutter(cases);
  if (only.empty() || only == "throw") seine::bench::throws(cases);
  if (only.empty() || only == "cusp") seine::bench::cusp_speeds(cases);
  return 0;
}
