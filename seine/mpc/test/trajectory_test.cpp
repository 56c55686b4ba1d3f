// Trajectories as the planner makes them: starts and stops at rest, both gears, gear changes.
#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/mpc/test/drive.hpp"
#include "seine/traj/minco.hpp"

namespace seine::mpc {
namespace {

constexpr std::uint64_t kSeed = 20294;
const vehicle::Model kCar = small_car();

// u(t) from 0 to 1 over one piece: 10 w³ − 15 w⁴ + 6 w⁵ is at rest with no acceleration at both ends.
traj::Quintic rest_to_rest() {
  return {0.0, 0.0, 0.0, 10.0, -15.0, 6.0};
}

// One segment along an arc-like quintic: from `from`, `length` metres in `gear`, bending by about `bend` 1/m.
traj::Segment segment(const geom::Pose2& from, int gear, double length, double bend, double wait) {
  const geom::Vec2 d = from.direction(), n = geom::left_normal(d);
  traj::Segment s;
  s.gear = gear, s.wait = wait;
  // p(u) = from + η ℓ u d + ½ κ ℓ² g(u) n with g = u³(2 − u) … : no curvature at either end where gears
  // change.
  const traj::Quintic along{0.0, gear * length, 0.0, 0.0, 0.0, 0.0};
  const double side = 0.5 * bend * length * length;
  const traj::Quintic across{0.0, 0.0, 0.0, side * 10.0 / 6.0, -side * 5.0 / 6.0, 0.0};
  std::array<traj::Quintic, 2> piece{};
  for (std::size_t k = 0; k < 6; ++k) {
    const geom::Vec2 c = along[k] * d + across[k] * n;
    piece[0][k] = c.x, piece[1][k] = c.y;
  }
  piece[0][0] += from.x, piece[1][0] += from.y;
  s.curve.push_back(piece);
  s.progress.push_back(rest_to_rest());
  // The fastest u̇ is 1.875 / h, the largest ü 5.77 / h²: keeps to 2 m/s and 2.5 m/s².
  s.piece_duration = std::max(1.875 * 1.2 * length / 2.0, std::sqrt(5.78 * 1.2 * length / 2.5));
  return s;
}

geom::Pose2 end_of(const traj::Segment& s) {
  return traj::evaluate(s, s.duration()).pose;
}

// Forwards, back, forwards again, with a pause.
traj::RobotTrajectory manoeuvre(Rng& rng) {
  traj::RobotTrajectory t;
  geom::Pose2 at{rng.normal(), rng.normal(), rng.uniform(-3, 3)};
  int gear = rng.below(2) == 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    t.segments.push_back(
        segment(at, gear, rng.uniform(0.6, 3.0), rng.uniform(-0.5, 0.5), i == 1 ? 0.7 : 0.0));
    at = end_of(t.segments.back());
    gear = -gear;
  }
  return t;
}

TEST(Tracker, FollowsManoeuvresWithGearChangesAndStopsWhereTheyEnd) {
  Rng rng(kSeed);
  double worst = 0.0, worst_heading = 0.0, worst_end = 0.0, sum = 0.0;
  int count = 0;
  for (int i = 0; i < effort(30, 5); ++i) {
    const traj::RobotTrajectory trajectory = manoeuvre(rng);
    Tracker tracker(kCar);
    const Course course = course_of(trajectory, kCar.wheelbase);
    State state = course(0).state;
    const double period = tracker.options().period;
    for (double t = 0.0; t < trajectory.arrival() + 1.0; t += period) {
      const Command command = tracker.step(state, trajectory, t);
      EXPECT_EQ(command.source, Source::tracking);
      state = advance(state, command.input, kCar.wheelbase, period);
      const State wanted = course(t + period).state;
      const double off = std::hypot(state.x - wanted.x, state.y - wanted.y);
      worst = std::max(worst, off), sum += off * off, ++count;
      worst_heading = std::max(worst_heading, std::abs(geom::wrap_angle(state.heading - wanted.heading)));
    }
    const State goal = course(trajectory.arrival()).state;
    worst_end = std::max(worst_end, std::hypot(state.x - goal.x, state.y - goal.y));
    EXPECT_LT(std::abs(state.speed), 1e-3);
  }
  std::printf("manoeuvres: %.1e m rms, worst %.1e m, %.1e rad; at rest %.1e m off\n", std::sqrt(sum / count),
              worst, worst_heading, worst_end);
  EXPECT_LT(worst, 0.01) << "seed " << kSeed;
  EXPECT_LT(worst_heading, 0.02) << "seed " << kSeed;
  EXPECT_LT(worst_end, 2e-3) << "seed " << kSeed;
}

TEST(Tracker, CatchesUpWithAManoeuvreFromBesideIt) {
  Rng rng(kSeed + 1);
  for (int i = 0; i < effort(20, 3); ++i) {
    const traj::RobotTrajectory trajectory = manoeuvre(rng);
    Tracker tracker(kCar);
    const Course course = course_of(trajectory, kCar.wheelbase);
    State state = course(0).state;
    state.x += 0.03 * rng.normal(), state.y += 0.03 * rng.normal(), state.heading += 0.05 * rng.normal();
    const auto moments =
        drive(tracker, kCar, course, {.start = state, .duration = trajectory.arrival() + 1.0});
    // The segments are two metres and less: what is off sideways can be taken back within them for the most
    // part.
    EXPECT_LT(moments.back().distance(), 0.05) << "seed " << kSeed + 1 << ", case " << i;
    EXPECT_LT(std::abs(moments.back().state.speed), 0.01);
  }
}

TEST(Tracker, EveryQuadraticProgrammeIsSolvedExactly) {
  Rng rng(kSeed + 2);
  double worst_bound = 0.0, worst_gradient = 0.0;
  int iterations = 0, steps = 0;
  for (int i = 0; i < 10; ++i) {
    const traj::RobotTrajectory trajectory = manoeuvre(rng);
    Tracker tracker(kCar);
    State state = course_of(trajectory, kCar.wheelbase)(0).state;
    state.y += 0.05 * rng.normal();
    for (double t = 0.0; t < trajectory.arrival(); t += 0.05, ++steps) {
      const Command command = tracker.step(state, trajectory, t);
      const optim::KktResiduals kkt =
          kkt_residuals(tracker.problem(), tracker.solver().x(), tracker.solver().y());
      worst_bound = std::max(worst_bound, kkt.primal), worst_gradient = std::max(worst_gradient, kkt.dual);
      iterations += command.qp.iterations;
      state = advance(state, command.input, kCar.wheelbase, 0.05);
    }
  }
  std::printf("%d programmes: bounds %.1e, gradient %.1e, %.2f iterations each\n", steps, worst_bound,
              worst_gradient, static_cast<double>(iterations) / steps);
  EXPECT_LT(worst_bound, 1e-6);
  EXPECT_LT(worst_gradient, 1e-5);
}

}  // namespace
}  // namespace seine::mpc
