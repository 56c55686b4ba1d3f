#include "seine/sim/preconditions.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "seine/base/error.hpp"
#include "seine/world/check.hpp"

namespace seine::sim {
namespace {

void require(bool fine, const std::string& what) {
  if (!fine) throw InputError("simulate: " + what);
}

bool has_way(const traj::RobotTrajectory& way) {
  for (const traj::Segment& segment : way.segments)
    if (segment.curve.empty() || segment.progress.empty()) return false;
  return way.stands || !way.segments.empty();
}

bool span(double from, double duration) {
  return std::isfinite(from) && std::isfinite(duration) && duration >= 0.0;
}

void expect_faults(const Faults& faults, std::size_t robots, std::size_t targets) {
  for (const Faults::LostFix& f : faults.lost_fixes)
    require(f.robot < robots && span(f.from, f.duration), "a lost fix of no car or at no time");
  for (const Faults::FailedControl& f : faults.failed_controls)
    require(f.robot < robots && span(f.at, f.duration), "a failed controller of no car or at no time");
  for (const Faults::LateReplan& f : faults.late_replans)
    require(span(f.from, f.duration), "a late plan at no time");
  for (const Faults::TargetJump& f : faults.target_jumps)
    require(f.target < targets && span(f.from, f.duration), "a jump of no target or at no time");
  for (const Faults::Breakdown& f : faults.breakdowns)
    require(f.robot < robots && std::isfinite(f.at), "a breakdown of no car or at no time");
}

}  // namespace

void expect_preconditions(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                          const Controller& controller, const SimulationOptions& options) {
  world::expect_numbers(scenario);
  require(!scenario.robots.empty(), "the team is empty, expected at least one car");
  require(plan.robots.size() == scenario.robots.size(),
          "the plan is for " + std::to_string(plan.robots.size()) + " cars, expected the " +
              std::to_string(scenario.robots.size()) + " of the scenario");
  for (std::size_t k = 0; k < plan.robots.size(); ++k)
    require(has_way(plan.robots[k]), "the plan has no way for " + scenario.robots[k].name);
  require(std::isfinite(plan.makespan()), "the plan has no end");
  require(static_cast<bool>(controller), "there is no controller");
  require(options.replan_period > 0.0 && options.replan_deadline > 0.0,
          "the period and the deadline of new plans, expected more than 0 s");
  expect_faults(options.faults, scenario.robots.size(), scenario.targets.size());
}

}  // namespace seine::sim
