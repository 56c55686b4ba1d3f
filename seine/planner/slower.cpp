#include "seine/planner/slower.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seine::planner {
namespace {

using certify::Kind;

constexpr double kSlowest = 4.0;  // times
constexpr int kRounds = 6;        // the certificate names only the worst instant of each kind
// The certificate follows a value beyond its limit up to 1e-3 of the limit.
constexpr double kReserve = 1.0 + 1.5e-3;
constexpr double kTouch = 1e-9;  // s: an instant where two segments meet belongs to both

// By how much more time the quantity comes down to its limit; nothing for what time does not change.
std::optional<double> stretch_for(const certify::Violation& v) {
  const double ratio = kReserve * std::abs(v.value) / v.limit;
  switch (v.kind) {
    case Kind::speed:
    case Kind::reverse_speed:
    case Kind::steering_rate:
    case Kind::gear:
      return ratio;
    case Kind::acceleration:
    case Kind::lateral_acceleration:
    case Kind::braking:
      return std::sqrt(ratio);
    default:
      return std::nullopt;
  }
}

bool moving_start(const world::Scenario& scenario, std::size_t robot) {
  return scenario.robots[robot].start_speed != 0.0;
}

// How many times slower each of a car's segments has to be.
using Factors = std::vector<double>;

// False when no segment that may be slowed is under way then.
bool note(const traj::RobotTrajectory& car, double time, double factor, bool rolling, Factors& factors) {
  bool met = false;
  double begin = 0.0;
  for (std::size_t i = 0; i < car.segments.size(); ++i) {
    begin += car.segments[i].wait;
    const double end = begin + car.segments[i].duration();
    if (time >= begin - kTouch && time <= end + kTouch) {
      if (rolling && i == 0) return false;
      factors[i] = std::max(factors[i], factor);
      met = true;
    }
    begin = end;
  }
  return met;
}

}  // namespace

std::optional<double> slowing(const certify::Certificate& certificate) {
  double most = 1.0;
  for (const certify::Violation& v : certificate.violations) {
    const std::optional<double> factor = stretch_for(v);
    if (!factor || v.robot < 0 || !(*factor <= kSlowest)) return std::nullopt;
    most = std::max(most, *factor);
  }
  return most;
}

std::optional<traj::TeamTrajectory> slowed(const world::Scenario& scenario,
                                           const certify::Certificate& certificate,
                                           const traj::TeamTrajectory& plan, Clock clock) {
  const std::optional<double> most = slowing(certificate);
  if (!most) return std::nullopt;
  std::vector<Factors> factors;
  for (const traj::RobotTrajectory& car : plan.robots)
    factors.emplace_back(car.segments.size(), clock == Clock::common ? *most : 1.0);
  for (std::size_t k = 0; k < factors.size(); ++k)
    if (clock == Clock::common && moving_start(scenario, k)) return std::nullopt;
  for (const certify::Violation& v : certificate.violations) {
    const auto k = static_cast<std::size_t>(v.robot);
    if (!note(plan.robots[k], v.time, *stretch_for(v), moving_start(scenario, k), factors[k]))
      return std::nullopt;
  }
  traj::TeamTrajectory result = plan;
  for (std::size_t k = 0; k < factors.size(); ++k)
    for (std::size_t i = 0; i < factors[k].size(); ++i) {
      traj::Segment& segment = result.robots[k].segments[i];
      segment.piece_duration *= factors[k][i];
      if (clock == Clock::common) segment.wait *= *most;
    }
  return result;
}

std::optional<Slowed> certified_slower(const world::Scenario& scenario, const world::StaticMap& map,
                                       const certify::Certificate& certificate,
                                       const traj::TeamTrajectory& plan, const certify::Options& options) {
  for (const Clock clock : {Clock::own, Clock::common}) {
    if (clock == Clock::common && scenario.robots.size() < 2) break;
    if (clock == Clock::own && scenario.net) continue;  // who holds a net keeps time with the others
    Slowed now{plan, certificate};
    for (int round = 0; round < kRounds && !options.deadline.expired(); ++round) {
      std::optional<traj::TeamTrajectory> slower = slowed(scenario, now.certificate, now.plan, clock);
      if (!slower) break;
      now.certificate = certify::certify(scenario, map, *slower, options);
      now.plan = std::move(*slower);
      if (now.plan.makespan() > kSlowest * plan.makespan()) break;
      if (now.certificate.holds) return now;
    }
  }
  return std::nullopt;
}

}  // namespace seine::planner
