// An enemy of the certificate: ./dev bench deceive [MINUTES] [options], docs/certificate.md#an-enemy.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "bench/deceive/clean.hpp"
#include "bench/deceive/mutants.hpp"
#include "bench/deceive/search.hpp"
#include "seine/base/error.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/scenario_file.hpp"

namespace seine::deceive {
namespace {

constexpr int kSteps = 60;     // of a search from genes …
constexpr int kMutants = 150;  // … and from a certified plan
constexpr int kFilesPerName = 4;

struct Tally {
  long attacks = 0, tried = 0, accepted = 0, deceived = 0;
};

/// All that attack number `seed` does follows from the seed.
Attack attack(std::uint64_t seed, const std::vector<Construction>& all, const std::string& only) {
  Rng rng(seed);
  const int choice = rng.below(static_cast<int>(all.size()) + 6);
  if (choice < static_cast<int>(all.size())) {
    const Construction& construction = all[static_cast<std::size_t>(choice)];
    if (!only.empty() && only != construction.name) return {};
    return attack_by(construction, rng, kSteps);
  }
  if (!only.empty() && only != "mutant") return {};
  const std::optional<Case> plan = certified_case(rng);
  if (!plan) return {};
  return attack_from(*plan, rng, kMutants);
}

class Campaign {
 public:
  Campaign(double seconds, std::uint64_t first, std::string only, std::filesystem::path folder)
      : end_(std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long>(1e3 * seconds))),
        next_(first),
        only_(std::move(only)),
        folder_(std::move(folder)) {}

  /// @return how many cases deceived the certificate
  long run(unsigned threads) {
    std::filesystem::create_directories(folder_);
    std::vector<std::thread> crew;
    for (unsigned i = 0; i < threads; ++i)
      crew.emplace_back([this] {
        while (std::chrono::steady_clock::now() < end_) one(next_++);
      });
    for (std::thread& worker : crew) worker.join();
    return summary();
  }

  void one(std::uint64_t seed) {
    Attack done;
    try {
      done = attack(seed, all_, only_);
    } catch (const Error& error) {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), error.what());
      return;
    }
    if (done.best.name.empty()) return;
    const std::scoped_lock lock(mutex_);
    Tally& tally = tallies_[done.best.name];
    ++tally.attacks;
    tally.tried += done.tried;
    tally.accepted += done.accepted;
    if (!done.deceived()) return;
    ++tally.deceived;
    report(seed, done, tally.deceived);
  }

 private:
  void report(std::uint64_t seed, const Attack& done, long number) {
    const std::string stem = done.best.name + "-" + std::to_string(seed);
    std::printf("%s: accepted, and wrong\n%s", stem.c_str(), describe(done.verdict.faults).c_str());
    if (number <= kFilesPerName) save(done.best, folder_ / stem);
    std::fflush(stdout);
  }

  static void save(const Case& made, const std::filesystem::path& stem) {
    try {
      planner::PlanResult result;
      result.plan = made.plan;
      io::save_scenario(made.scenario, stem.string() + ".yaml");
      io::save_plan(made.scenario, result, stem.string() + ".json");
      std::printf("    %s.yaml, %s.json\n", stem.c_str(), stem.c_str());
    } catch (const Error& error) {
      std::printf("    cannot be written: %s\n", error.what());
    }
  }

  long summary() const {
    long deceived = 0;
    std::printf("%-20s %9s %9s %9s %9s\n", "", "attacks", "cases", "accepted", "deceived");
    for (const auto& [name, t] : tallies_) {
      std::printf("%-20s %9ld %9ld %9ld %9ld\n", name.c_str(), t.attacks, t.tried, t.accepted, t.deceived);
      deceived += t.deceived;
    }
    return deceived;
  }

  std::chrono::steady_clock::time_point end_;
  std::atomic<std::uint64_t> next_;
  std::string only_;
  std::filesystem::path folder_;
  std::vector<Construction> all_ = constructions();
  std::mutex mutex_;
  std::map<std::string, Tally> tallies_;
};

/// What is true of files that are at hand, beside what the certificate says.
int look_at_files(const std::string& scenario, const std::string& plan) {
  const Case made{.name = plan, .scenario = io::load_scenario(scenario), .plan = io::load_plan(plan).plan};
  const Verdict verdict = judge(made, {}, true);
  std::printf("%s: %s\n%s", plan.c_str(), verdict.accepted ? "accepted" : verdict.complaint.c_str(),
              describe(verdict.faults).c_str());
  return verdict.accepted && verdict.ratio > 1.0 ? 1 : 0;
}

int complain() {
  std::fprintf(
      stderr,
      "usage: seine_deceive [MINUTES] [--seed FIRST] [--only NAME] [--threads N] [--out FOLDER]\n"
      "       seine_deceive --one SEED           one attack again\n"
      "       seine_deceive --look SCENARIO PLAN  what is true of a plan\n"
      "       seine_deceive --clean N [--seed FIRST]  plans of all families: is a clean one refused?\n");
  return 2;
}

int run(const std::vector<std::string>& arguments) {
  double minutes = 1.0;
  std::uint64_t first = 1;
  long clean = 0;
  bool single = false;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::string only, folder = "out/deceive";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    if (i + 1 >= arguments.size() || !name.starts_with("--")) {
      if (i > 0 || (minutes = std::atof(name.c_str())) <= 0.0) return complain();
      continue;
    }
    const std::string& value = arguments[++i];
    if (name == "--look" && i + 1 < arguments.size()) return look_at_files(value, arguments[i + 1]);
    if (name == "--seed" || name == "--one")
      first = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--only")
      only = value;
    else if (name == "--out")
      folder = value;
    else if (name == "--threads")
      threads = static_cast<unsigned>(std::max(1, std::atoi(value.c_str())));
    else if (name == "--clean")
      clean = std::atol(value.c_str());
    else
      return complain();
    single = single || name == "--one";
  }
  if (clean > 0) return refused_though_clean(first, clean, threads, folder) > 0 ? 1 : 0;
  Campaign campaign(60.0 * minutes, first, only, folder);
  if (single) return campaign.one(first), 0;
  const long deceived = campaign.run(threads);
  std::printf("%ld deceived the certificate\n", deceived);
  return deceived > 0 ? 1 : 0;
}

}  // namespace
}  // namespace seine::deceive

int main(int count, char** arguments) {
  try {
    return seine::deceive::run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seine_deceive: %s\n", error.what());
    return 2;
  }
}
