#include "seine/sim/pacing.hpp"

#include <algorithm>
#include <cmath>

namespace seine::sim {
namespace {

constexpr double kKeepingUp = 0.03;   // m behind that nobody waits for: what localisation errs by …
constexpr double kTimeBehind = 0.01;  // s, … and what fast cars err by on top of that
constexpr double kSlowing = 4.0;      // 1/m: of the rate, for each metre more
constexpr double kSlowest = 0.4;      // a car that is lost must not hold up the team for ever
constexpr double kMoving = 1e-3;      // m/s

}  // namespace

double lag_behind(const geom::Pose2& car, const traj::State& reference) {
  const double ahead = geom::dot(car.position() - reference.pose.position(), reference.pose.direction());
  return reference.speed < 0.0 ? ahead : -ahead;
}

double pace_of(const traj::TeamTrajectory& plan, const PlanClock& clock, std::span<const Car> cars) {
  double pace = 1.0;
  for (std::size_t k = 0; k < cars.size(); ++k) {
    const traj::State reference = clock.state_on(plan.robots[k]);
    const double speed = std::abs(reference.speed);
    if (speed < kMoving) continue;
    const double lag = lag_behind(cars[k].belief().pose, reference);
    pace = std::min(pace, 1.0 - kSlowing * (lag - kKeepingUp - kTimeBehind * speed));
  }
  return std::max(pace, kSlowest);
}

}  // namespace seine::sim
