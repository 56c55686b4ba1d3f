// The filter on measured flights, where nobody knows the model, and on made ones, where its statistics can be
// checked.
#include "seine/sim/flight_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/sim/flights.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 41;

void expect_better(const char* name, const std::vector<Track>& tracks, double noise,
                   const std::array<double, 3>& published) {
  ASSERT_GE(tracks.size(), 15u);
  const Errors errors = errors_of(tracks, noise);
  std::printf(
      "%-24s %3zu flights, median error in mm after 30/50/70 %%: filter %.0f/%.0f/%.0f, line fit "
      "%.0f/%.0f/%.0f\n",
      name, tracks.size(), errors.filter[0], errors.filter[1], errors.filter[2], errors.line[0],
      errors.line[1], errors.line[2]);
  for (std::size_t p = 0; p < kParts.size(); ++p) {
    EXPECT_LT(errors.filter[p], errors.line[p]) << name;
    EXPECT_LT(errors.filter[p], published[p]) << name;
  }
}

TEST(FlightFilter, PredictsMeasuredFlightsBetterThanAStraightLine) {
  expect_better("thrown balls", thrown_balls(SEINE_DATA_DIR), 0.001, {49.0, 38.0, 26.0});
  expect_better("table tennis 2019", table_tennis(SEINE_DATA_DIR, "2019"), 0.01, {207.0, 164.0, 121.0});
  expect_better("table tennis 2020", table_tennis(SEINE_DATA_DIR, "2020"), 0.01, {207.0, 164.0, 121.0});
}

TEST(FlightFilter, TracksThroughGapsOfTheCamera) {
  for (const Track& track : table_tennis(SEINE_DATA_DIR, "20", true)) {
    FlightFilter seen({.noise = 0.01});
    for (std::size_t i = 0; i + 5 < track.size(); ++i) seen.observe(track[i].time, track[i].position);
    EXPECT_LT(norm(seen.position_at(track.back().time) - track.back().position), 0.15);
  }
}

net::Target random_throw(Rng& rng) {
  net::Target target;
  target.position = {rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0), rng.uniform(1.5, 2.5)};
  target.velocity = {rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0), rng.uniform(2.0, 6.0)};
  target.drag = rng.uniform(0.0, 0.1);
  return target;
}

Vec3 noise(Rng& rng, double sigma) {
  const double x = rng.normal(), y = rng.normal(), z = rng.normal();
  return sigma * Vec3{x, y, z};
}

TEST(FlightFilter, ItsTargetCrossesTheRimWithinTheErrorItStates) {
  constexpr int kRounds = effort(300, 100);
  constexpr double kRim = 1.0, kNoise = 0.02;
  Rng rng(kSeed);
  int within = 0;
  for (int round = 0; round < kRounds; ++round) {
    const net::Target truth = random_throw(rng);
    const net::Flight flight(truth);
    FlightFilter seen({.noise = kNoise});
    for (int i = 0; i < 30; ++i) seen.observe(0.01 * i, flight.at(0.01 * i).position + noise(rng, kNoise));
    const auto target = seen.target(truth, kRim);
    ASSERT_TRUE(target);
    const auto promised = net::Flight(*target).crossing(kRim), met = flight.crossing(kRim);
    ASSERT_TRUE(promised && met);
    const double off = geom::norm((promised->state.position - met->state.position).ground());
    if (off <= promised->error) ++within;
  }
  // Two sigmas of an ellipse's longer axis, in two dimensions: between 86 % (circle) and 95 % (line).
  EXPECT_GE(within, 0.84 * kRounds) << "seed " << kSeed;
}

TEST(FlightFilter, TheTargetMeetsTheRimWhereTheFilterExpectsIt) {
  Rng rng(kSeed);
  for (int round = 0; round < 50; ++round) {
    const net::Flight flight(random_throw(rng));
    FlightFilter seen({.noise = 0.03});
    for (int i = 0; i < 25; ++i) seen.observe(0.01 * i, flight.at(0.01 * i).position + noise(rng, 0.03));
    const auto crossing = net::Flight(*seen.target({}, 1.0)).crossing(1.0);
    ASSERT_TRUE(crossing);
    const Vec3 expected = seen.position_at(crossing->state.time);
    EXPECT_NEAR(norm(expected - crossing->state.position), 0.0, 2e-3) << "round " << round;
  }
}

TEST(FlightFilter, LeavesOutliersOut) {
  Rng rng(kSeed);
  const net::Target truth = random_throw(rng);
  const net::Flight flight(truth);
  FlightFilter clean({.noise = 0.01}), dirty({.noise = 0.01});
  int left_out = 0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.01 * i;
    const Vec3 place = flight.at(t).position + noise(rng, 0.01);
    clean.observe(t, place);
    const bool outlier = i > 5 && i % 7 == 0;
    if (!dirty.observe(t, outlier ? place + noise(rng, 1.0) : place)) ++left_out;
  }
  EXPECT_GE(left_out, 7);
  EXPECT_NEAR(norm(dirty.position_at(0.8) - clean.position_at(0.8)), 0.0, 0.02);
}

TEST(FlightFilter, FollowsWhenItWasTheTrackThatWasWrong) {
  Rng rng(kSeed);
  net::Target told = random_throw(rng);
  for (std::size_t i = 0; i < 6; ++i) told.covariance[i][i] = 1e-6;
  net::Target truth = told;
  truth.velocity += Vec3{1.5, -1.0, 0.5};
  const net::Flight flight(truth);
  FlightFilter seen({.noise = 0.01});
  seen.expect(told);
  for (int i = 1; i < 60; ++i) seen.observe(0.01 * i, flight.at(0.01 * i).position + noise(rng, 0.01));
  EXPECT_NEAR(norm(seen.position_at(0.9) - flight.at(0.9).position), 0.0, 0.05);
}

TEST(FlightFilter, KnowsWhatItWasTold) {
  Rng rng(kSeed);
  const net::Target told = random_throw(rng);
  FlightFilter seen;
  seen.expect(told);
  const auto target = seen.target(told, 1.0);
  EXPECT_NEAR(norm(target->velocity - told.velocity), 0.0, 1e-9);
  EXPECT_NEAR(norm(seen.position_at(told.time + 0.8) - net::Flight(told).at(told.time + 0.8).position), 0.0,
              1e-3);
  EXPECT_FALSE(FlightFilter().target(told, 1.0));
}

}  // namespace
}  // namespace seine::sim
