// Random drops onto nets held still: what the rules of the catch promise must happen. Hundreds of them are
// ./dev bench drive's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "seine/base/effort.hpp"
#include "seine/sim/drops.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 31;

// Nets take a while to swing out, so a few are hung and copied.
struct Hung {
  net::Net net;
  std::vector<Vec3> corners;
  CordNet physics;
};

std::vector<Hung> hang(int robots, double rebound, std::initializer_list<double> openings) {
  net::Net net = world::family_net(robots);
  net.rebound = rebound;
  std::vector<Hung> hung;
  for (const double opening : openings) {
    const std::vector<Vec3> corners = held(net, opening);
    hung.push_back({net, corners, CordNet(net, corners, material_of_rebound(rebound))});
  }
  return hung;
}

class Teams : public ::testing::TestWithParam<int> {};

TEST_P(Teams, CertifiedDropsAreCaughtAndStay) {
  constexpr int kDrops = effort(16, 2);
  Rng rng(kSeed);
  const std::vector<Hung> nets = hang(GetParam(), 0.25, {0.88, 0.94});
  int kept = 0;
  for (int i = 0; i < kDrops; ++i) {
    const Hung& hung = nets[static_cast<std::size_t>(rng.below(2))];
    Drop drop;
    do {
      drop = random_drop(rng, hung.net, on_ground(hung.corners), {});
    } while (!certified(hung.net, drop));
    CordNet physics = hung.physics;
    const CatchWatch watch = watch_drop(physics, hung.corners, drop);
    const net::Catch& c = drop.measured;
    if (watch.fate() == Fate::caught) {
      ++kept;
      EXPECT_GE(watch.lowest(), c.bottom);
    } else {
      std::printf("drop %d: %s at %.1f m/s, %.0f deg, margins %.2f and %.2f m, opening %.2f\n", i,
                  name_of(watch.fate()), c.speed, c.angle * 180.0 / std::numbers::pi, c.rim_margin,
                  c.contact_margin, c.opening);
    }
  }
  EXPECT_GE(kept, kDrops) << "seed " << kSeed;
}

TEST_P(Teams, NothingGoesThroughTheNet) {
  Rng rng(kSeed);
  const std::vector<Hung> nets = hang(GetParam(), 0.5, {0.95});
  for (int i = 0; i < effort(10, 2); ++i) {
    CordNet physics = nets[0].physics;
    const Drop drop = random_drop(rng, nets[0].net, on_ground(nets[0].corners),
                                  {.slowest = 11.0, .fastest = 14.0, .margin = 0.0});
    EXPECT_NE(watch_drop(physics, nets[0].corners, drop).fate(), Fate::leak) << "drop " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Drop, Teams, ::testing::Values(3, 4, 6));

// 90th percentile over nets of three, four and six corners of steep drops on their middle.
double measured_rebound(double wanted) {
  Rng rng(kSeed);
  std::vector<double> rebounds;
  for (const int robots : {3, 4, 6}) {
    for (const Hung& hung : hang(robots, wanted, {0.86, 0.90, 0.95})) {
      const std::vector<geom::Vec2> hold = on_ground(hung.corners);
      const double inner = net::margin_inside(hold, {});
      for (int i = 0; i < 8; ++i) {
        CordNet physics = hung.physics;
        const Drop drop =
            random_drop(rng, hung.net, hold, {.flattest = std::numbers::pi / 9.0, .margin = 0.4 * inner});
        rebounds.push_back(rebound(physics, hung.corners, hung.net, drop));
      }
    }
  }
  std::sort(rebounds.begin(), rebounds.end());
  return rebounds[rebounds.size() * 9 / 10];
}

TEST(Rebound, IsTheOneAskedFor) {
  if (effort(1, 0) == 0) GTEST_SKIP() << "statistics of many drops, nothing that others do not touch";
  for (const double wanted : {0.25, 0.5}) {
    const double measured = measured_rebound(wanted);
    std::printf("rebound asked for %.2f, measured %.3f\n", wanted, measured);
    EXPECT_NEAR(measured, wanted, 0.03) << "seed " << kSeed;
  }
}

}  // namespace
}  // namespace seine::sim
