// The table of docs/front-end-coordination.md. Not a test of anything, so it only runs when asked for:
//   search_test --gtest_also_run_disabled_tests --gtest_filter='TeamGuessTable.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "seine/search/team_guess.hpp"
#include "seine/search/test/team_check.hpp"
#include "seine/world/families.hpp"

namespace seine::search {
namespace {

struct Row {
  int complete = 0;
  double milliseconds = 0.0, slowest = 0.0;
  double makespan = 0.0, makespan_alone = 0.0, mean = 0.0, mean_alone = 0.0;
};

void add(Row& row, const TeamGuess& guess, double milliseconds, int scenes) {
  row.milliseconds += milliseconds / scenes;
  row.slowest = std::max(row.slowest, milliseconds);
  if (!guess.complete) return;
  ++row.complete;
  const double share = 1.0 / (scenes * static_cast<double>(guess.robots.size()));
  double latest = 0.0;
  for (const TimedPath& motion : guess.robots) {
    latest = std::max(latest, motion.arrival());
    row.mean += share * motion.arrival();
  }
  row.makespan += latest / scenes;
  row.makespan_alone += *std::max_element(guess.alone.begin(), guess.alone.end()) / scenes;
  for (const double alone : guess.alone) row.mean_alone += share * alone;
}

void measure(world::Family family, int robots, int scenes) {
  Row row;
  for (int seed = 0; seed < scenes; ++seed) {
    const world::Scenario scenario = world::generate(family, robots, static_cast<std::uint64_t>(seed));
    const std::clock_t before = std::clock();  // of the processor: other programs do not count
    const world::StaticMap map(scenario);
    const TeamGuess guess = guess_team(scenario, map, {});
    add(row, guess, 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, scenes);
    if (guess.complete) TeamCheck(scenario, guess.robots).run();
  }
  std::printf("| %s %d | %d of %d | %.1f (%.1f) | %.2f (%.2f) | %.2f (%.2f) | +%.1f %% |\n",
              world::name_of(family), robots, row.complete, scenes, row.milliseconds, row.slowest,
              row.makespan, row.makespan_alone, row.mean, row.mean_alone,
              100.0 * (row.mean / row.mean_alone - 1.0));
}

TEST(TeamGuessTable, DISABLED_Print) {
  std::printf(
      "| scenes | complete, sound | ms mean (max) | makespan (alone) s | mean arrival (alone) s | delay |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const int robots : {8, 14, 20, 26}) measure(world::Family::random, robots, 100);
  for (const int robots : {50, 100}) measure(world::Family::random, robots, 20);
  for (const int robots : {8, 14, 20, 26, 50, 100}) measure(world::Family::swap, robots, 1);
  for (const int robots : {4, 8, 16}) measure(world::Family::corridor, robots, 10);
  for (const int robots : {4, 8, 16}) measure(world::Family::parking, robots, 10);
}

}  // namespace
}  // namespace seine::search
