#include "seine/planner/front_door.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "seine/base/error.hpp"
#include "seine/base/workers.hpp"
#include "seine/planner/net_session.hpp"
#include "seine/planner/session.hpp"
#include "seine/world/check.hpp"
#include "seine/world/frame.hpp"
#include "seine/world/granted_speed.hpp"

namespace seine::planner {
namespace {

/// The scenario with the start speeds that are granted; nothing when those are what it has.
std::optional<world::Scenario> lawful(const world::Scenario& scenario) {
  std::optional<world::Scenario> result;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const world::Robot& robot = scenario.robots[i];
    if (robot.model < 0 || static_cast<std::size_t>(robot.model) >= scenario.models.size()) continue;
    const auto granted = world::granted_speed(scenario.model_of(robot).limits, robot.start_speed);
    if (!granted || *granted == robot.start_speed) continue;
    if (!result) result = scenario;
    result->robots[i].start_speed = *granted;
  }
  return result;
}

PlanResult from_afar(const Method& method, const world::Scenario& scenario, geom::Vec2 origin,
                     const Options& options) {
  const Stopwatch watch;
  const world::StaticMap map(scenario);
  world::expect_sound(scenario, map);
  Options near = options;
  traj::TeamTrajectory previous;
  if (options.previous != nullptr) {
    previous = traj::shifted(*options.previous, -1.0 * origin);
    near.previous = &previous;
  }
  PlanResult result = method(world::seen_from(scenario, origin), near);
  result.plan = traj::shifted(std::move(result.plan), origin);
  if (result.certified || !result.certificate.violations.empty()) {
    const bool was = result.certified;
    result.certificate =
        certify::certify(scenario, map, result.plan, {.threads = Workers(options.threads).count()});
    result.certified = was && result.certificate.holds;
    if (was && !result.certified) result.reason = result.certificate.violations.front().text;
    result.times.certify += result.certificate.seconds;
  }
  result.times.compute = watch.seconds();
  return result;
}

}  // namespace

PlanResult by(const Method& method, const world::Scenario& scenario, const Options& options) {
  if (std::isnan(options.deadline_s)) throw InputError("plan: the deadline is not a number");
  if (options.previous != nullptr) {
    if (options.previous->robots.size() != scenario.robots.size())
      throw InputError("plan: the previous plan is for " + std::to_string(options.previous->robots.size()) +
                       " cars, expected the " + std::to_string(scenario.robots.size()) + " of the scenario");
    if (!std::isfinite(options.previous_time))
      throw InputError("plan: the previous plan's time is not finite");
  }
  world::expect_numbers(scenario);
  const std::optional<world::Scenario> mended = lawful(scenario);
  const world::Scenario& task = mended ? *mended : scenario;
  const auto origin = world::local_origin(task);
  PlanResult result = origin ? from_afar(method, task, *origin, options) : method(task, options);
  if (result.certified || result.impossible) return result;
  if (options.cancelled != nullptr && *options.cancelled)
    result.reason = "interrupted before there was a certified plan";
  else if (result.reason.empty())  // huge tasks may use up a short deadline before the first attempt
    result.reason =
        "gave up at the deadline while the task was still being read and checked; allow more time";
  return result;
}

PlanResult plan(const world::Scenario& scenario, const Options& options) {
  const Method joint = [](const world::Scenario& task, const Options& how) {
    return task.net ? NetSession(task, how).run() : Session(task, how).run();
  };
  return by(joint, scenario, options);
}

}  // namespace seine::planner
