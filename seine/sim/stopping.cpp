#include "seine/sim/stopping.hpp"

#include <algorithm>
#include <cmath>

namespace seine::sim {
namespace {

constexpr double kReserve = 0.95;     // of the limit of acceleration
constexpr double kSlow = 0.05;        // m/s: slower cars do not matter
constexpr double kHardest = 20.0;     // 1/s
constexpr double kSearchBack = 1.0;   // s of plan that are looked through for a place
constexpr double kSearchAhead = 0.3;  // s
constexpr double kSearchStep = 0.01;  // s
constexpr double kCatchUp = 8.0;      // 1/s: how fast a lead over a silent car is given up
constexpr double kResponse = 0.05;    // s in which the rate is brought to where it should be

}  // namespace

RateChange possible_change(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                           const PlanClock& clock, std::optional<std::size_t> except) {
  RateChange change{-kHardest, kHardest};
  const double rate = clock.rate();
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    if (k == except) continue;
    const traj::State state = plan.robots[k].at(clock.time());
    const double speed = std::abs(state.speed);
    if (speed < kSlow) continue;
    const double limit = kReserve * scenario.model_of(scenario.robots[k]).limits.acceleration;
    const double planned = rate * rate * std::copysign(state.acceleration, state.acceleration * state.speed);
    change.least = std::max(change.least, (-limit - planned) / speed);
    change.most = std::min(change.most, (limit - planned) / speed);
  }
  change.least = std::min(change.least, 0.0);
  change.most = std::max(change.most, 0.0);
  return change;
}

double progress_of(const traj::RobotTrajectory& way, geom::Vec2 place, double guess) {
  double best = guess, nearest = 1e300;
  for (double t = guess + kSearchAhead; t >= guess - kSearchBack; t -= kSearchStep) {
    const double squared = geom::squared_norm(way.at(t).pose.position() - place);
    if (squared < nearest) nearest = squared, best = t;
  }
  return best;
}

double stopping_change(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                       const PlanClock& clock, std::optional<std::size_t> silent,
                       const CarState& silent_state) {
  const RateChange possible = possible_change(scenario, plan, clock, silent);
  if (!silent) return possible.least;
  const traj::RobotTrajectory& way = plan.robots[*silent];
  const double there = progress_of(way, silent_state.pose.position(), clock.time());
  const double planned = std::abs(way.at(there).speed);
  const double its_rate = planned > kSlow ? std::min(1.0, std::abs(silent_state.speed) / planned) : 0.0;
  const double wanted = std::clamp(its_rate - kCatchUp * (clock.time() - there), 0.0, 1.0);
  return std::clamp((wanted - clock.rate()) / kResponse, possible.least, possible.most);
}

}  // namespace seine::sim
