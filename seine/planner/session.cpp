#include "seine/planner/session.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "seine/base/error.hpp"
#include "seine/certify/certificate.hpp"
#include "seine/planner/moving_bodies.hpp"
#include "seine/world/check.hpp"

namespace seine::planner {
namespace {

constexpr int kPolishRounds = 4;
constexpr int kAttempts = 6;
constexpr double kTick = 0.05;           // of the time a car takes to drive its own length
constexpr double kPenaltyRaise = 3.0;
constexpr double kClearanceRaise = 0.01;  // car lengths, on top of what was missed

std::vector<int> everybody(std::size_t count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

Session::Session(const world::Scenario& scenario, const Options& options)
    : scenario_(scenario), options_(options), deadline_(options.deadline_s), workers_(options.threads), map_(scenario) {}

PlanResult Session::run() {
  const auto complaints = world::check(scenario_, map_);
  if (!complaints.empty()) {
    const std::string more = complaints.size() > 1 ? " (and " + std::to_string(complaints.size() - 1) + " more)" : "";
    throw InputError(scenario_.name + ": " + complaints.front() + more);
  }
  for (int attempt = 0; attempt < kAttempts && !deadline_.expired(); ++attempt) {
    if (!guess(static_cast<std::uint64_t>(attempt))) continue;
    prepare();
    solve(everybody(scenario_.robots.size()), true);
    polish();
    if (result_.certified) break;
    ++result_.repairs;
  }
  return finish();
}

bool Session::guess(std::uint64_t attempt) {
  const Stopwatch watch;
  report("guess", 0.0);
  search::GuessOptions options;
  options.deadline = deadline_;
  options.threads = workers_.count();
  options.seed = options_.seed + attempt;
  options.extra_robot_clearance = 0.01 * static_cast<double>(attempt) * scenario_.models.front().length();
  guess_ = search::guess_team(scenario_, map_, options);
  result_.times.guess += watch.seconds();
  if (!guess_.complete) result_.reason = guess_.reason;
  return guess_.complete;
}

void Session::prepare() {
  const Stopwatch watch;
  const std::size_t count = scenario_.robots.size();
  tasks_.assign(count, {});
  workers_.run(static_cast<int>(count), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    tasks_[i] = fit(guess_.robots[i], scenario_, scenario_.robots[i], map_);
  });
  demands_ = {std::vector<double>(count, 1.0), std::vector<double>(count * count, 0.0), std::vector<double>(count, 0.0)};
  solution_.assign(count, {});
  result_.plan.robots.assign(count, {});
  units_ = trajopt::units_of(tasks_);
  tick_ = kTick * units_.time;
  double last = 0.0;
  for (const search::TimedPath& path : guess_.robots) last = std::max(last, path.arrival());
  ticks_ = static_cast<int>(std::ceil(1.2 * last / tick_)) + 80;
  result_.times.corridor += watch.seconds();
}

trajopt::Task Session::task_for(const std::vector<int>& robots) const {
  trajopt::Task task;
  const std::size_t count = scenario_.robots.size();
  task.units = units_, task.tick = tick_, task.ticks = ticks_;
  task.robot_clearance = scenario_.margins.robot;
  task.bodies = moving_obstacles(scenario_, tick_, ticks_);
  std::vector<char> active(count, 0);
  for (const int k : robots) {
    const auto i = static_cast<std::size_t>(k);
    active[i] = 1;
    task.robots.push_back(tasks_[i]);
    task.robots.back().penalty_scale = demands_.penalty_scale[i];
    for (double& b : task.robots.back().corridor.b) b -= demands_.obstacle_extra[i];
  }
  for (const int a : robots)
    for (const int b : robots)
      task.pair_extra.push_back(demands_.pair_extra[static_cast<std::size_t>(a) * count + static_cast<std::size_t>(b)]);
  for (std::size_t i = 0; i < count; ++i)
    if (!active[i])
      task.bodies.push_back(driven(result_.plan.robots[i], scenario_.model_of(scenario_.robots[i]),
                                   scenario_.margins.robot, tick_, ticks_));
  return task;
}

void Session::solve(const std::vector<int>& robots, bool from_guess) {
  const Stopwatch watch;
  report("optimise", from_guess ? 0.0 : 0.5);
  trajopt::JointProblem problem(task_for(robots), {}, workers_);
  std::vector<double> x = problem.initial();
  const auto slice = [&](std::size_t i) {
    return std::span(x).subspan(static_cast<std::size_t>(problem.offsets()[i]),
                                static_cast<std::size_t>(problem.offsets()[i + 1] - problem.offsets()[i]));
  };
  if (!from_guess)
    for (std::size_t i = 0; i < robots.size(); ++i)
      std::ranges::copy(solution_[static_cast<std::size_t>(robots[i])], slice(i).begin());
  const trajopt::SolveSummary summary = problem.solve(x, deadline_, !from_guess);
  result_.iterations += summary.soft_evaluations + summary.stiff_evaluations;
  const traj::TeamTrajectory solved = problem.trajectory(x);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto k = static_cast<std::size_t>(robots[i]);
    solution_[k].assign(slice(i).begin(), slice(i).end());
    result_.plan.robots[k] = solved.robots[i];
  }
  result_.times.optimise += watch.seconds();
}

bool Session::certify() {
  const Stopwatch watch;
  report("certify", 0.0);
  certify::Options options;
  options.threads = workers_.count();
  options.deadline = deadline_;
  result_.certificate = certify::certify(scenario_, map_, result_.plan, options);
  result_.certified = result_.certificate.holds;
  result_.times.certify += watch.seconds();
  return result_.certified;
}

void Session::polish() {
  for (int round = 0; round < kPolishRounds; ++round) {
    if (certify() || deadline_.expired()) return;
    solve(raise_demands(), false);
  }
  certify();
}

// Asks more where the certificate found fault; returns the cars at fault.
std::vector<int> Session::raise_demands() {
  std::vector<char> at_fault(scenario_.robots.size(), 0);
  const std::size_t count = at_fault.size();
  for (const certify::Violation& v : result_.certificate.violations) {
    if (v.robot < 0) continue;
    const auto a = static_cast<std::size_t>(v.robot);
    at_fault[a] = 1;
    const double raise = kClearanceRaise * units_.length + std::max(0.0, std::min(v.limit - v.value, 0.1 * units_.length));
    switch (v.kind) {
      case certify::Kind::robot_clearance: {
        const auto b = static_cast<std::size_t>(v.other);
        at_fault[b] = 1;
        demands_.pair_extra[a * count + b] += raise;
        demands_.pair_extra[b * count + a] += raise;
        break;
      }
      case certify::Kind::obstacle_clearance:
      case certify::Kind::bounds: demands_.obstacle_extra[a] += raise; break;
      default: demands_.penalty_scale[a] *= kPenaltyRaise; break;
    }
  }
  std::vector<int> robots;
  for (std::size_t k = 0; k < count; ++k)
    if (at_fault[k]) robots.push_back(static_cast<int>(k));
  return robots;
}

void Session::report(const char* stage, double fraction) const {
  if (options_.progress) options_.progress({stage, fraction});
}

PlanResult Session::finish() {
  if (result_.certified) {
    result_.reason.clear();
    result_.quality = measure(result_.plan);
  } else if (deadline_.expired()) {
    result_.reason = "no certified plan before the deadline";
  } else if (!result_.certificate.violations.empty()) {
    result_.reason = result_.certificate.violations.front().text;
  }
  result_.times.compute = watch_.seconds();
  return std::move(result_);
}

PlanResult plan(const world::Scenario& scenario, const Options& options) { return Session(scenario, options).run(); }

}  // namespace seine::planner
