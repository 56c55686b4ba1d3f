#include "seine/baseline/letter/letter.hpp"

#include <algorithm>

#include "seine/base/error.hpp"
#include "seine/baseline/letter/guess.hpp"
#include "seine/baseline/letter/problem.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/planner/front_door.hpp"
#include "seine/world/check.hpp"

namespace seine::baseline::letter {
namespace {

void refuse_if(bool wrong, const world::Scenario& scenario, const std::string& what) {
  if (wrong) throw InputError(scenario.name + ": " + what);
}

void expect_within_reach(const world::Scenario& scenario, const planner::Options& options,
                         const Settings& settings) {
  const auto complaints = settings.complaints();
  refuse_if(!complaints.empty(), scenario, complaints.empty() ? "" : complaints.front());
  refuse_if(options.previous != nullptr, scenario, "the letter's method cannot go on from an earlier plan");
  for (const world::Obstacle& obstacle : scenario.obstacles)
    refuse_if(!obstacle.motion.empty(), scenario,
              obstacle.name + " moves; the letter's method knows obstacles that stand only");
}

NetTask net_task(const world::Scenario& scenario, const planner::Ablation& without) {
  const net::Net& net = *scenario.net;
  NetTask task{.size = !without.size, .topology = !without.topology};
  for (std::size_t i = 0; i < net.size(); ++i) {
    task.attachments.push_back(net.attachments[i].at);
    task.longest.push_back(net.stretch * net::rest_distance(net, i, (i + 1) % net.size()));
  }
  for (const net::Target& target : scenario.targets) {
    if (without.catching) break;
    // The letter plans in the plane: where the target comes through the rim's height, and when.
    const auto crossing = net::Flight(target).crossing(net.rim());
    refuse_if(!crossing, scenario, "a target never falls through the height of the net");
    task.meetings.push_back({{crossing->state.position.x, crossing->state.position.y}, crossing->state.time});
  }
  if (scenario.delivery)
    task.delivery = NetTask::Region{scenario.delivery->center, scenario.delivery->radius};
  return task;
}

/// One call of plan().
class Run {
 public:
  Run(const world::Scenario& scenario, const planner::Options& options, const Settings& settings)
      : scenario_(scenario),
        options_(options),
        settings_(settings),
        deadline_(options.deadline_s, options.cancelled),
        workers_(options.threads),
        map_(scenario) {}

  planner::PlanResult operator()() {
    const auto complaints = world::check(scenario_, map_);
    refuse_if(!complaints.empty(), scenario_, complaints.empty() ? "" : complaints.front());
    expect_within_reach(scenario_, options_, settings_);
    result_.claimed = false;
    if (guess()) {
      optimise();
      certify();
    }
    result_.times.compute = watch_.seconds();
    return std::move(result_);
  }

 private:
  bool guess() {
    const Stopwatch watch;
    report("guess");
    Guess found = letter::guess(scenario_, map_, settings_, deadline_, workers_);
    task_.robots = std::move(found.robots);
    task_.robot_clearance = scenario_.margins.robot;
    for (RobotTask& robot : task_.robots) {
      robot.free_cusps = !options_.without.cusps;
      robot.free_end = robot.free_end && !options_.without.relaxation;
    }
    if (scenario_.net) task_.net = net_task(scenario_, options_.without);
    result_.times.guess = watch.seconds();
    result_.reason = found.reason;
    return found.reason.empty();
  }

  void optimise() {
    const Stopwatch watch;
    report("optimise");
    Problem problem(task_, settings_, workers_);
    std::vector<double> x = problem.initial();
    const optim::LbfgsSummary summary = problem.solve(x, deadline_);
    const Claim claim = problem.claim(x, summary);
    result_.claimed = claim.holds;
    result_.reason = claim.reason;
    result_.plan = problem.trajectory(x);
    result_.iterations = summary.evaluations;
    result_.times.optimise = watch.seconds();
  }

  void certify() {
    const Stopwatch watch;
    report("certify");
    certify::Options options;
    options.threads = workers_.count();
    options.deadline = deadline_;
    result_.certificate = certify::certify(scenario_, map_, result_.plan, options);
    result_.certified = result_.certificate.holds;
    result_.times.certify = watch.seconds();
    if (result_.certified)
      result_.reason.clear();
    else if (*result_.claimed)
      result_.reason = result_.certificate.violations.front().text;
    result_.quality = planner::measure(result_.plan);
  }

  void report(const char* stage) const {
    if (options_.progress) options_.progress({stage, 0.0});
  }

  const world::Scenario& scenario_;
  const planner::Options& options_;
  const Settings& settings_;
  Stopwatch watch_;
  Deadline deadline_;
  Workers workers_;
  world::StaticMap map_;
  TeamTask task_;
  planner::PlanResult result_;
};

}  // namespace

std::vector<std::string> Settings::complaints() const {
  std::vector<std::string> found;
  const auto expect = [&found](bool holds, const char* what) {
    if (!holds) found.emplace_back(what);
  };
  expect(cusp_speed > 0.0 && cusp_speed < 1e3,
         "the cusp speed must be positive: a time-flat curve has no heading at rest");
  expect(knee > 0.0 && smoothing > 0.0 && clamp > 0.0 && clamp < 0.5 && blend > 0.0,
         "knee, smoothing and blend must be positive, the clamp below a half");
  expect(intervals > 0 && end_intervals > 0, "a piece needs at least one interval of quadrature");
  expect(jerk_weight > 0.0 && time_weight > 0.0, "the weights of jerk and time must be positive");
  expect(*std::ranges::min_element(weight) >= 0.0 && centring >= 0.0 && catching >= 0.0 && end_weight >= 0.0,
         "weights must not be negative");
  expect(piece_length > 0.0 && speed_share > 0.0 && acceleration_share > 0.0 && corridor_reach > 0.0,
         "the guess needs positive piece lengths, shares and reach");
  expect(memory > 0 && past > 0 && evaluations > 0 && decrease > 0.0, "the solver needs positive numbers");
  return found;
}

planner::PlanResult plan(const world::Scenario& scenario, const planner::Options& options,
                         const Settings& settings) {
  return planner::by(
      [&](const world::Scenario& task, const planner::Options& how) { return Run(task, how, settings)(); },
      scenario, options);
}

}  // namespace seine::baseline::letter
