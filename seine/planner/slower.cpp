#include "seine/planner/slower.hpp"

#include <algorithm>
#include <cmath>

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

bool stretch_at(traj::RobotTrajectory& car, double time, double factor, bool rolling) {
  bool met = false;
  double begin = 0.0;
  for (std::size_t i = 0; i < car.segments.size(); ++i) {
    traj::Segment& segment = car.segments[i];
    begin += segment.wait;
    const double end = begin + segment.duration();
    if (time >= begin - kTouch && time <= end + kTouch) {
      if (rolling && i == 0) return false;
      segment.piece_duration *= factor;
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
  traj::TeamTrajectory result = plan;
  for (const certify::Violation& v : certificate.violations) {
    if (clock == Clock::common) break;
    const auto k = static_cast<std::size_t>(v.robot);
    // Times are those of the plan as it was: where two stretches of a car are at fault the later one is
    // looked for too early, and found by the next certificate.
    if (!stretch_at(result.robots[k], v.time, *stretch_for(v), moving_start(scenario, k)))
      return std::nullopt;
  }
  if (clock == Clock::own) return result;
  for (std::size_t k = 0; k < result.robots.size(); ++k) {
    if (moving_start(scenario, k)) return std::nullopt;
    for (traj::Segment& segment : result.robots[k].segments)
      segment.wait *= *most, segment.piece_duration *= *most;
  }
  return result;
}

std::optional<Slowed> certified_slower(const world::Scenario& scenario, const world::StaticMap& map,
                                       const certify::Certificate& certificate,
                                       const traj::TeamTrajectory& plan, const certify::Options& options) {
  for (const Clock clock : {Clock::own, Clock::common}) {
    if (clock == Clock::common && scenario.robots.size() < 2) break;
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
