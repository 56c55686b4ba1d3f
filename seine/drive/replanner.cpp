#include "seine/drive/replanner.hpp"

#include "seine/base/deadline.hpp"
#include "seine/base/error.hpp"
#include "seine/planner/planner.hpp"

namespace seine::drive {
namespace {

// Of the time for an answer: the planner looks at its clock between steps, and must not be found late by one.
constexpr double kShare = 0.8;

}  // namespace

sim::Replanner replanner(const ReplannerOptions& options) {
  return [options](const sim::Situation& situation) -> sim::Replanned {
    const Stopwatch watch;
    try {
      planner::PlanResult result =
          planner::plan(situation.scenario, {.deadline_s = kShare * situation.deadline,
                                             .threads = options.threads,
                                             .seed = options.seed,
                                             .previous = &situation.plan,
                                             .previous_time = situation.plan_time});
      return {result.certified, std::move(result.plan), watch.seconds()};
    } catch (const InputError&) {
      // The task has become one that nobody could plan, as when the target now falls on an obstacle.
      return {.seconds = watch.seconds()};
    }
  };
}

}  // namespace seine::drive
