// Plans that look odd, or leave little room, but are sound: none may be refused. The seed is printed.
#include <gtest/gtest.h>

#include "seine/base/effort.hpp"
#include "seine/certify/test/brute_force.hpp"

namespace seine::certify::test {
namespace {

using traj::Segment;

const int kTrials = effort(60, 8);

TEST(SoundPlans, AnotherUnitOfTheParameter) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(18000 + static_cast<std::uint64_t>(trial));
    traj::RobotTrajectory way = straight({0, 0, rng.uniform(-3.0, 3.0)}, 3.0, 4.0);
    Segment& segment = way.segments[0];
    // The second half of the curve is written with |p'| `factor` times as long, u̇ is as many times smaller.
    const double factor = std::pow(10.0, rng.uniform(-2.0, 2.0));
    const Vec2 d = way.at(0.0).pose.direction();
    segment.curve = {{Quintic{0.0, 1.5 * d.x}, Quintic{0.0, 1.5 * d.y}},
                     {Quintic{1.5 * d.x, 1.5 * factor * d.x}, Quintic{1.5 * d.y, 1.5 * factor * d.y}}};
    const double v = 1.0;
    segment.progress = {hermite({0, 0, 0}, {1, v, 0}), hermite({1, v / factor, 0}, {1 + 1 / factor, 0, 0})};
    segment.piece_duration = 2.0;
    if (factor < 1.0) {  // a curve of many pieces then
      segment.curve.resize(1);
      for (double from = 0.0; from < 1.0 / factor; ++from) {
        const double x = 1.5 + 1.5 * factor * from;
        segment.curve.push_back({Quintic{x * d.x, 1.5 * factor * d.x}, Quintic{x * d.y, 1.5 * factor * d.y}});
      }
    }
    const traj::TeamTrajectory plan{{way}};
    const world::Scenario scenario = scenario_for(plan, car(), 100.0);
    const Certificate certificate = certify(scenario, world::StaticMap(scenario), plan);
    EXPECT_TRUE(certificate.holds) << "seed " << 18000 + trial << ", factor " << factor << ": "
                                   << summary(certificate);
  }
}

TEST(SoundPlans, RoundedToNineDigits) {
  const auto rounded = [](double value) { return std::round(value * 1e9) * 1e-9; };
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(19000 + static_cast<std::uint64_t>(trial));
    traj::TeamTrajectory plan{{random_way(rng, {{0.0, 0.0, 0.3}, 0.1}, {.segments = 2})}};
    const world::Scenario scenario = scenario_for(plan, car(), 100.0);
    for (Segment& segment : plan.robots[0].segments) {
      for (auto& piece : segment.curve)
        for (Quintic& c : piece)
          for (double& value : c) value = rounded(value);
      for (Quintic& c : segment.progress)
        for (double& value : c) value = rounded(value);
    }
    const Certificate certificate = certify(scenario, world::StaticMap(scenario), plan);
    EXPECT_TRUE(certificate.holds) << "seed " << 19000 + trial << ": " << summary(certificate);
  }
}

TEST(SoundPlans, AnHourJustBelowALimit) {
  // Circles at constant speed, every limit 0.01 % above what is driven, for a tenth of the time under
  // sanitizers.
  const int pieces = effort(1800, 180);
  const double kappa = 1.2, speed = 2.0, l = 4.0;
  Segment segment, stop;
  Bent at{{}, kappa};
  segment.piece_duration = 2.0;
  for (int i = 0; i < pieces; ++i) {
    // In eight parts a quintic keeps the circle's curvature to 1e-9.
    for (int k = 0; k < 8; ++k) {
      const double angle = kappa * l * (i + k / 8.0), next = kappa * l * (i + (k + 1) / 8.0);
      const auto on = [&](double a) {
        return Bent{{std::sin(a) / kappa, (1.0 - std::cos(a)) / kappa, a}, kappa};
      };
      segment.curve.push_back(curve_piece(on(angle), on(next), 1, l / 8.0));
      at = on(next);
    }
    segment.progress.push_back({8.0 * i, 8.0});
  }
  stop.curve.push_back(curve_piece(at, drive(at, kappa, 1, 2.0), 1, 2.0));
  stop.piece_duration = 2.0;
  stop.progress = {{0.0, 2.0, -1.0}};
  traj::TeamTrajectory plan{{traj::RobotTrajectory{{segment, stop}}}};
  world::Scenario scenario = scenario_for(plan, car(), 100.0);
  scenario.robots[0].start_speed = speed;
  const Extremes most = extremes_of(plan.robots[0], 0.4, 20.0);
  scenario.models[0].limits.speed = most.speed * 1.0001;
  scenario.models[0].limits.lateral_acceleration = most.lateral_acceleration * 1.0001;
  scenario.models[0].limits.steering = std::atan(0.4 * most.curvature * 1.0001);
  const Certificate certificate = certify(scenario, world::StaticMap(scenario), plan);
  EXPECT_TRUE(certificate.holds) << summary(certificate);
}

}  // namespace
}  // namespace seine::certify::test
