#include "seine/sim/target_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/error.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 61;

std::vector<Sighting> watch(const Noise& noise, double seconds, Vec3 velocity = {}) {
  TargetSensor sensor(noise, kSeed);
  std::vector<Sighting> sights;
  for (int i = 0; i <= std::lround(1e3 * seconds); ++i) {
    const double t = 1e-3 * i;
    sensor.look(t, t * velocity);
    while (const auto sight = sensor.delivered(t)) {
      EXPECT_GE(t + 1e-9, sight->time + noise.sight_delay);
      sights.push_back(*sight);
    }
  }
  return sights;
}

TEST(TargetSensor, IdealOneSeesEverythingAtOnce) {
  const auto sights = watch({}, 1.0, {1.0, 2.0, 3.0});
  ASSERT_EQ(sights.size(), 101u);
  for (const Sighting& sight : sights)
    EXPECT_NEAR(norm(sight.position - sight.time * Vec3{1.0, 2.0, 3.0}), 0.0, 1e-12);
}

TEST(TargetSensor, KeepsItsRateItsNoiseAndItsGaps) {
  const Noise noise{.sight_period = 1.0 / 60.0, .sight_delay = 0.03, .sight = 0.02, .dropouts = 0.1};
  const auto sights = watch(noise, 50.0);
  EXPECT_NEAR(static_cast<double>(sights.size()), 50.0 * 60.0 * 0.9, 80.0);
  double squares = 0.0;
  for (const Sighting& sight : sights) squares += dot(sight.position, sight.position);
  EXPECT_NEAR(std::sqrt(squares / (3.0 * static_cast<double>(sights.size()))), 0.02, 0.001);
}

TEST(TargetSensor, SomeSightsAreWrong) {
  const auto sights = watch({.outliers = 0.05}, 50.0);
  int wrong = 0;
  for (const Sighting& sight : sights) wrong += norm(sight.position) > 0.1 ? 1 : 0;
  EXPECT_NEAR(wrong, 250, 60);
}

TEST(Noise, HasThreeNames) {
  EXPECT_EQ(noise_named("none").sight, 0.0);
  EXPECT_LT(noise_named("low").position, noise_named("high").position);
  EXPECT_THROW(noise_named("medium"), InputError);
}

}  // namespace
}  // namespace seine::sim
