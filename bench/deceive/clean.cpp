#include "bench/deceive/clean.hpp"

#include <cstdio>
#include <mutex>

#include "bench/deceive/mutants.hpp"
#include "bench/deceive/search.hpp"
#include "seine/base/workers.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/planner/planner.hpp"

namespace seine::deceive {
namespace {

struct Counts {
  long plans = 0, none = 0, unsound = 0, refused = 0, refused_clean = 0;
};

class CleanCampaign {
 public:
  CleanCampaign(std::uint64_t first, long count, std::filesystem::path folder)
      : first_(first), count_(count), folder_(std::move(folder)) {}

  long run(unsigned threads) {
    std::filesystem::create_directories(folder_);
    Workers(static_cast<int>(threads)).run(static_cast<int>(count_), [this](int i) {
      one(first_ + static_cast<std::uint64_t>(i));
    });
    std::printf(
        "%ld certified plans (%ld tasks without one), %ld refused after writing and reading, %ld of "
        "them clean; %ld certified ones wrong by the look\n",
        counts_.plans, counts_.none, counts_.refused, counts_.refused_clean, counts_.unsound);
    return counts_.refused_clean + counts_.unsound;
  }

 private:
  void one(std::uint64_t seed) {
    Rng rng(seed);
    std::optional<Case> made = certified_case(rng);
    if (!made) {
      const std::scoped_lock lock(mutex_);
      ++counts_.none;
      return;
    }
    planner::PlanResult result;
    result.plan = made->plan;
    Case read = *made;
    read.plan = io::parse_plan(io::plan_text(made->scenario, result), "plan.json").plan;
    const Verdict verdict = judge(read, {}, true);
    const bool wrong = verdict.ratio > 1.0;
    const std::scoped_lock lock(mutex_);
    ++counts_.plans;
    counts_.unsound += verdict.accepted && wrong ? 1 : 0;
    counts_.refused += verdict.accepted ? 0 : 1;
    counts_.refused_clean += verdict.accepted || wrong ? 0 : 1;
    if (verdict.accepted && !wrong) return;
    const std::string stem = (folder_ / ("clean-" + std::to_string(seed))).string();
    std::printf("%s (%s): %s\n%s", stem.c_str(), read.scenario.name.c_str(),
                verdict.accepted ? "accepted, and wrong" : verdict.complaint.c_str(),
                describe(verdict.faults).c_str());
    std::fflush(stdout);
    io::save_scenario(read.scenario, stem + ".yaml");
    io::save_plan(read.scenario, result, stem + ".json");
  }

  std::uint64_t first_;
  long count_;
  std::filesystem::path folder_;
  std::mutex mutex_;
  Counts counts_;
};

}  // namespace

long refused_though_clean(std::uint64_t first_seed, long count, unsigned threads,
                          const std::filesystem::path& folder) {
  return CleanCampaign(first_seed, count, folder).run(threads);
}

}  // namespace seine::deceive
