#include "seine/sim/car_plant.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/sim/localisation.hpp"
#include "seine/world/families.hpp"

namespace seine::sim {
namespace {

constexpr std::uint64_t kSeed = 51;
constexpr double kTick = 1e-3;  // s

CarState run(CarPlant& car, double seconds, geom::Vec2 pull = {}) {
  for (int i = 0; i < std::lround(seconds / kTick); ++i) car.advance(kTick, pull);
  return car.state();
}

TEST(CarPlant, IdealCarDrivesCirclesAndParabolas) {
  const vehicle::Model model = world::standard_car();
  CarPlant straight(model, {}, {}, kSeed);
  straight.command({1.5, 0.0});
  const CarState end = run(straight, 1.0);
  EXPECT_NEAR(end.speed, 1.5, 1e-12);
  EXPECT_NEAR(end.pose.x, 0.75, 1e-12);
  const double steering = 0.4, radius = model.wheelbase / std::tan(steering);
  CarPlant turning(model, {}, {.speed = 2.0, .steering = steering}, kSeed);
  turning.command({0.0, steering});
  const CarState turned = run(turning, 0.8);
  EXPECT_NEAR(turned.pose.x, radius * std::sin(1.6 / radius), 1e-9);
  EXPECT_NEAR(turned.pose.y, radius * (1.0 - std::cos(1.6 / radius)), 1e-9);
}

TEST(CarPlant, BackwardsTooAndWithinItsLimits) {
  const vehicle::Model model = world::standard_car();
  CarPlant car(model, {}, {}, kSeed);
  car.command({-99.0, 99.0});
  const CarState end = run(car, 0.5);
  EXPECT_NEAR(end.speed, -0.5 * model.limits.acceleration, 1e-12);
  EXPECT_DOUBLE_EQ(end.steering, model.limits.steering);
  EXPECT_LT(end.pose.heading, 0.0) << "backwards with the wheel to the left";
}

TEST(CarPlant, AnswersLateAndSlowly) {
  const vehicle::Model model = world::standard_car();
  const Noise noise{.dead_time = 0.1, .acceleration_lag = 0.2, .steering_lag = 0.3};
  CarPlant car(model, noise, {}, kSeed);
  car.command({2.0, 0.5});
  EXPECT_EQ(run(car, 0.099).acceleration, 0.0);
  const CarState later = run(car, 0.2);
  EXPECT_NEAR(later.acceleration, 2.0 * (1.0 - std::exp(-1.0)), 0.01);
  EXPECT_NEAR(later.steering, 0.5 * (1.0 - std::exp(-0.2 / 0.3)), 0.003);
}

TEST(CarPlant, TurnsItsWheelNoFasterThanItCan) {
  vehicle::Model model = world::standard_car();
  model.limits.steering_rate = 0.5;
  CarPlant car(model, {}, {}, kSeed);
  car.command({0.0, 0.6});
  EXPECT_NEAR(run(car, 0.4).steering, 0.2, 1e-9);
}

TEST(CarPlant, TheNetJerksItAndIsTakenUp) {
  const vehicle::Model model = world::standard_car();
  CarPlant car(model, {}, {}, kSeed);
  run(car, 0.1);
  // ∫ F/m e^(−t/τ) dt = F τ / m, and only along the wheels.
  EXPECT_NEAR(run(car, 1.5, {3.0, 50.0}).speed, 3.0 * kTakeUp / kCarMass, 1e-3 * kTakeUp);
  EXPECT_NEAR(car.state().pose.y, 0.0, 1e-12);
  CarPlant holding(model, {}, {}, kSeed);
  EXPECT_NEAR(run(holding, 1.0, {4.0, 0.0}).speed, 0.0, 1e-12) << "it held the net before";
}

TEST(CarPlant, BrokenItStopsAndStays) {
  const vehicle::Model model = world::standard_car();
  CarPlant car(model, {}, {.speed = 2.4}, kSeed);
  car.break_down();
  car.command({3.0, 0.5});
  const CarState end = run(car, 2.0);
  EXPECT_NEAR(end.speed, 0.0, 1e-9);
  EXPECT_NEAR(end.pose.x, 2.4 * 2.4 / (2.0 * 0.7 * model.limits.acceleration), 0.01);
}

TEST(CarPlant, SlipIsUnbiasedAndTheSameForTheSameSeed) {
  const vehicle::Model model = world::standard_car();
  double sum = 0.0, squares = 0.0;
  constexpr int kCars = 100;
  for (std::uint64_t seed = 0; seed < kCars; ++seed) {
    CarPlant a(model, {.slip = 0.03}, {.speed = 2.0}, seed), b(model, {.slip = 0.03}, {.speed = 2.0}, seed);
    EXPECT_EQ(run(a, 0.5).pose, run(b, 0.5).pose);
    const double off = a.state().pose.x - 1.0;
    sum += off, squares += off * off;
  }
  EXPECT_NEAR(sum / kCars, 0.0, 0.01);
  EXPECT_GT(squares / kCars, 1e-4);
}

// Mean and largest distance between belief and truth on a curve.
struct Off {
  double mean = 0.0, largest = 0.0, at_end = 0.0;
};

Off drive_blind(const Noise& noise, std::uint64_t seed, double drop_from, double drop_to) {
  const vehicle::Model model = world::standard_car();
  const CarState start{.speed = 2.0, .steering = 0.2};
  CarPlant car(model, noise, start, seed);
  car.command({0.0, 0.2});
  Localisation belief(model, noise, start, seed + 1000);
  Off off;
  constexpr int kTicks = 300;
  for (int i = 1; i <= kTicks; ++i) {
    const double t = i * Localisation::kOdometryPeriod;
    belief.look(run(car, Localisation::kOdometryPeriod), t < drop_from || t >= drop_to);
    off.at_end = geom::norm(belief.belief().pose.position() - car.state().pose.position());
    off.mean += off.at_end / kTicks;
    off.largest = std::max(off.largest, off.at_end);
  }
  return off;
}

TEST(Localisation, WithoutNoiseItKnowsTheTruth) {
  EXPECT_LT(drive_blind({}, kSeed, 9.0, 9.0).largest, 1e-4);
  EXPECT_LT(drive_blind({}, kSeed, 1.0, 1.5).largest, 1e-3) << "also on its wheels alone";
}

TEST(Localisation, ItsErrorIsTheOneStated) {
  for (const char* name : {"low", "high"}) {
    const Noise noise = noise_named(name);
    double mean = 0.0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) mean += drive_blind(noise, seed, 9.0, 9.0).mean / 50.0;
    // The mean length of a vector of two normal errors, less what the wheels smooth, plus what they add.
    EXPECT_NEAR(mean, noise.position * std::sqrt(0.5 * std::numbers::pi), 0.35 * noise.position) << name;
  }
}

TEST(Localisation, LivesThroughHalfASecondWithoutFixes) {
  double worst = 0.0, end = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Off off = drive_blind(noise_named("low"), seed, 1.0, 1.5);
    worst = std::max(worst, off.largest);
    end += off.at_end / 50.0;
  }
  EXPECT_LT(worst, 0.06);
  EXPECT_LT(end, 0.015);
}

}  // namespace
}  // namespace seine::sim
