// The benchmarks of teams with a net: ./dev bench catch, ./dev bench ablation.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bench/net/carry_scene.hpp"
#include "bench/net/pocket_scene.hpp"
#include "seine/base/rng.hpp"
#include "seine/io/map_file.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/net_families.hpp"

namespace seine::bench {
namespace {

constexpr double kDeadline = 20.0;  // s
constexpr std::size_t kCarries = 20, kPasses = 5;
constexpr double kNudge = 0.12, kNudgeTime = 0.03;  // m and s: what a better estimate changes

using Make = std::function<std::optional<world::Scenario>(std::uint64_t)>;

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double largest(const std::vector<double>& values) {
  return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
}

struct Tally {
  int asked = 0, impossible = 0, certified = 0;
  std::vector<double> compute, guess, optimise, certify, makespan;
  std::string first_failure;
};

planner::PlanResult plan(const world::Scenario& scenario, planner::Options options) {
  options.deadline_s = kDeadline;
  return planner::plan(scenario, options);
}

struct Task {
  std::uint64_t seed;
  world::Scenario scenario;
  std::optional<traj::TeamTrajectory> previous;
};

bool proved_impossible(const planner::PlanResult& result) {
  return !result.certified && result.iterations == 0 && result.times.guess == 0.0;
}

void add(Tally& tally, const planner::PlanResult& result, std::uint64_t seed) {
  ++tally.asked;
  if (proved_impossible(result)) {
    ++tally.impossible;
    return;
  }
  if (!result.certified) {
    if (tally.first_failure.empty())
      tally.first_failure = "seed " + std::to_string(seed) + ": " + result.reason;
    return;
  }
  ++tally.certified;
  tally.compute.push_back(1e3 * result.times.compute);
  tally.guess.push_back(1e3 * result.times.guess);
  tally.optimise.push_back(1e3 * result.times.optimise);
  tally.certify.push_back(1e3 * result.times.certify);
  tally.makespan.push_back(result.quality.makespan);
}

void print(const std::string& name, const Tally& t) {
  double mean = 0.0;
  for (const double m : t.makespan) mean += m / static_cast<double>(t.makespan.size());
  std::printf("%-22s %3d of %3d  %7.1f %8.1f %6.1f  %7.1f %8.1f %8.2f  %8.2f\n", name.c_str(), t.certified,
              t.asked - t.impossible, median(t.compute), largest(t.compute),
              largest(t.compute) / median(t.compute), median(t.guess), median(t.optimise), median(t.certify),
              mean);
  if (t.impossible > 0) std::printf("    and %d proved impossible\n", t.impossible);
  if (!t.first_failure.empty()) std::printf("    %s\n", t.first_failure.c_str());
  std::fflush(stdout);
}

// The plan is the same in every pass; of its times the median counts. All tasks are planned once before any
// is planned again, so that a machine that is slow for a second is not taken for a hard task.
Tally measure(const std::vector<Task>& tasks) {
  std::vector<std::vector<planner::PlanResult>> runs(tasks.size());
  for (std::size_t pass = 0; pass < kPasses; ++pass)
    for (std::size_t i = 0; i < tasks.size(); ++i)
      runs[i].push_back(
          plan(tasks[i].scenario, {.previous = tasks[i].previous ? &*tasks[i].previous : nullptr}));
  Tally tally;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    std::sort(runs[i].begin(), runs[i].end(),
              [](const auto& a, const auto& b) { return a.times.compute < b.times.compute; });
    add(tally, runs[i][kPasses / 2], tasks[i].seed);
  }
  return tally;
}

Tally run(int instances, const Make& make) {
  std::vector<Task> tasks;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(instances); ++seed)
    if (auto scenario = make(seed)) tasks.push_back({seed, std::move(*scenario), {}});
  return measure(tasks);
}

// The target as a better estimate has it, planned from the plan that stands.
void replan(int robots, int instances) {
  std::vector<Task> tasks;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(instances); ++seed) {
    world::Scenario scenario = world::throw_scene(robots, seed);
    planner::PlanResult first = plan(scenario, {});
    if (!first.certified) continue;
    Rng rng(seed);
    net::Target& target = scenario.targets.front();
    target.position.x += rng.uniform(-kNudge, kNudge);
    target.position.y += rng.uniform(-kNudge, kNudge);
    target.time = std::max(0.0, target.time + rng.uniform(-kNudgeTime, kNudgeTime));
    tasks.push_back({seed, std::move(scenario), std::move(first.plan)});
  }
  print("replan, " + std::to_string(robots) + " cars", measure(tasks));
}

void carries() {
  const char* maps[] = {"gdc_1",       "gdc_2",       "intel",  "stata_basement",
                        "building_31", "levinelobby", "torino", "skirk"};
  std::vector<geom::OccupancyGrid> grids;
  for (const char* name : maps)
    grids.push_back(io::load_map(std::string(SEINE_DATA_DIR "/maps/ros/") + name + ".yaml"));
  for (const int robots : {3, 4}) {
    std::vector<Task> tasks;
    for (std::uint64_t seed = 0; tasks.size() < kCarries && seed < 10 * kCarries; ++seed)
      if (auto scenario = carry_scene(grids[seed % grids.size()], robots, seed))
        tasks.push_back({seed, std::move(*scenario), {}});
    print("carry in buildings, " + std::to_string(robots), measure(tasks));
  }
}

void catches(int instances) {
  std::printf(
      "%-22s certified   compute ms                guess  optimise  certify  travel s\n"
      "%-22s             median  slowest  ratio    (medians, ms)                mean\n",
      "", "");
  for (const int robots : {3, 4, 6})
    print("throw, " + std::to_string(robots) + " cars",
          run(instances, [&](std::uint64_t seed) { return world::throw_scene(robots, seed); }));
  for (const int robots : {3, 4, 6}) replan(robots, instances);
  for (const double width : {2.6, 2.2, 1.9})
    for (const int robots : {3, 4, 6}) {
      char name[64];
      std::snprintf(name, sizeof name, "gap %.1f m, %d cars", width, robots);
      print(name, run(std::max(1, instances * 2 / 5),
                      [&](std::uint64_t seed) { return world::gap_scene(robots, seed, width); }));
    }
  carries();
  for (const int robots : {3, 4, 6})
    print("throw, dense, " + std::to_string(robots) + " cars", run(instances, [&](std::uint64_t seed) {
            return world::throw_scene(robots, seed, world::Clutteredness::dense);
          }));
}

int cusps_of(const traj::TeamTrajectory& team) {
  int cusps = 0;
  for (const traj::RobotTrajectory& robot : team.robots)
    for (std::size_t i = 1; i < robot.segments.size(); ++i)
      cusps += robot.segments[i].gear != robot.segments[i - 1].gear;
  return cusps;
}

// Where a car changes gear first; where it ends if it never does.
geom::Pose2 first_cusp(const traj::RobotTrajectory& robot) {
  double t = 0.0;
  for (std::size_t i = 0; i < robot.segments.size(); ++i) {
    t += robot.segments[i].wait + robot.segments[i].duration();
    if (i + 1 < robot.segments.size() && robot.segments[i + 1].gear != robot.segments[i].gear) break;
  }
  return robot.at(t).pose;
}

// What each part of the method brings, on the same throws.
void ablation_of_throws(int instances) {
  const std::pair<const char*, planner::Ablation> variants[] = {{"everything", {}},
                                                                {"without catch", {.catching = true}},
                                                                {"without size", {.size = true}},
                                                                {"without topology", {.topology = true}},
                                                                {"without relaxation", {.relaxation = true}},
                                                                {"without cusps", {.cusps = true}}};
  for (const int robots : {3, 4}) {
    std::printf(
        "%d cars                certified  in the net  rim margin m  opening  too wide  travel s  cusps\n",
        robots);
    for (const auto& [name, without] : variants) {
      int certified = 0, caught = 0, wide = 0, cusps = 0;
      std::vector<double> margin, opening, travel;
      for (int seed = 0; seed < instances; ++seed) {
        const auto scenario = world::throw_scene(robots, static_cast<std::uint64_t>(seed));
        const planner::PlanResult result = plan(scenario, {.without = without});
        if (result.certificate.catches.empty()) continue;
        certified += result.certified;
        const net::Catch& c = result.certificate.catches.front();
        caught += c.rim_margin >= net::kRimMargin;
        wide += result.certificate.net.stretch.clearance < 0.0;
        cusps += cusps_of(result.plan);
        margin.push_back(c.rim_margin), opening.push_back(c.opening);
        travel.push_back(result.plan.makespan());
      }
      std::printf("%-20s %4d of %3d %11d %13.3f %8.3f %9d %9.2f %6d\n", name, certified, instances, caught,
                  median(margin), median(opening), wide, median(travel), cusps);
      std::fflush(stdout);
    }
  }
}

// Gear changes: where the guess had them, or free. Both on the instances that both solve.
void ablation_of_cusps(int instances) {
  std::printf(
      "\nout of a pocket       certified  travel s  acceleration cost  at the gear change: heading turns rad "
      " "
      "moves m\n");
  for (const int robots : {3, 4}) {
    int certified = 0, fixed_certified = 0;
    std::vector<double> travel, fixed_travel, effort, fixed_effort, turn, move;
    for (int seed = 0; seed < instances; ++seed) {
      const auto scenario = pocket_scene(robots, static_cast<std::uint64_t>(seed));
      const planner::PlanResult free = plan(scenario, {});
      const planner::PlanResult fixed = plan(scenario, {.without = {.cusps = true}});
      certified += free.certified, fixed_certified += fixed.certified;
      if (!free.certified || !fixed.certified) continue;
      travel.push_back(free.quality.makespan), fixed_travel.push_back(fixed.quality.makespan);
      effort.push_back(free.quality.acceleration_cost);
      fixed_effort.push_back(fixed.quality.acceleration_cost);
      for (std::size_t k = 0; k < free.plan.robots.size(); ++k) {
        const geom::Pose2 a = first_cusp(free.plan.robots[k]), b = first_cusp(fixed.plan.robots[k]);
        turn.push_back(std::abs(geom::wrap_angle(a.heading - b.heading)));
        move.push_back(geom::norm(a.position() - b.position()));
      }
    }
    std::printf("%d cars, cusps free    %4d of %3d %9.2f %18.1f %36.2f %8.2f\n", robots, certified, instances,
                median(travel), median(effort), median(turn), median(move));
    std::printf("%d cars, cusps fixed   %4d of %3d %9.2f %18.1f\n", robots, fixed_certified, instances,
                median(fixed_travel), median(fixed_effort));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace seine::bench

int main(int count, char** arguments) {
  const bool ablation = count > 1 && std::strcmp(arguments[1], "ablation") == 0;
  if (count < 2 || count > 3 || (!ablation && std::strcmp(arguments[1], "catch") != 0)) {
    std::fprintf(stderr, "usage: seine_net_bench catch|ablation [INSTANCES]\n");
    return 2;
  }
  const int instances = count > 2 ? std::max(1, std::atoi(arguments[2])) : ablation ? 40 : 100;
  if (!ablation) {
    seine::bench::catches(instances);
    return 0;
  }
  seine::bench::ablation_of_throws(instances);
  seine::bench::ablation_of_cusps(instances);
  return 0;
}
