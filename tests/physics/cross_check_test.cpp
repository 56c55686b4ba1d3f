// Two engines that share nothing but the mesh must tell the same story where both can be trusted: up to
// 8 m/s. MuJoCo's net is thicker (fat nodes), so heights agree to centimetres only.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "seine/sim/drops.hpp"
#include "tests/physics/mujoco_net.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 3;

double lowest(const NetPhysics& physics) {
  double z = physics.nodes().front().z;
  for (const Vec3 node : physics.nodes()) z = std::min(z, node.z);
  return z;
}

class TwoEngines : public ::testing::TestWithParam<int> {
 protected:
  TwoEngines()
      : net(world::family_net(GetParam())),
        corners(held(net, 0.92)),
        ours(net, corners, material_of_rebound(net.rebound)),
        theirs(net, corners, material_of_rebound(net.rebound)) {}

  net::Net net;
  std::vector<Vec3> corners;
  CordNet ours;
  MujocoNet theirs;
};

TEST_P(TwoEngines, HangAnObjectAtTheSameHeight) {
  const Ball ball{.position = {0.02, 0.01, 0.75}};
  for (NetPhysics* physics : {static_cast<NetPhysics*>(&ours), static_cast<NetPhysics*>(&theirs)}) {
    physics->add(ball);
    physics->advance(corners, 1.5);
  }
  const double formula = net.rim() - net::loaded_depth(net, on_ground(corners));
  std::printf("%d corners: lowest point of the net by the formula %.3f m, ours %.3f m, MuJoCo %.3f m\n",
              GetParam(), formula, lowest(ours), lowest(theirs));
  EXPECT_NEAR(lowest(ours), formula, 0.03);
  EXPECT_NEAR(lowest(theirs), formula, 0.09);
  EXPECT_NEAR(ours.ball(0).position.z, theirs.ball(0).position.z, 0.07);
}

TEST_P(TwoEngines, AgreeOnWhatIsCaught) {
  constexpr int kDrops = 3;
  Rng rng(kSeed);
  for (int i = 0; i < kDrops; ++i) {
    Drop drop;
    do {
      drop = random_drop(rng, net, on_ground(corners), {.fastest = 8.0});
    } while (!certified(net, drop));
    CordNet our = ours;
    MujocoNet their = theirs;
    const CatchWatch a = watch_drop(our, corners, drop), b = watch_drop(their, corners, drop);
    std::printf("%d corners, %.1f m/s: the fall ends at %.3f m, in MuJoCo at %.3f m\n", GetParam(),
                drop.measured.speed, a.lowest(), b.lowest());
    EXPECT_EQ(a.fate(), Fate::caught) << "drop " << i << ", seed " << kSeed;
    EXPECT_EQ(b.fate(), Fate::caught) << "drop " << i << ", seed " << kSeed;
    EXPECT_NEAR(a.lowest(), b.lowest(), 0.09) << "where the fall ends";
  }
}

TEST_P(TwoEngines, AgreeOnWhatIsMissed) {
  Drop drop;
  drop.target.position = {1.6, 0.0, 1.2};
  drop.target.velocity = {0.0, 0.0, -5.0};
  EXPECT_EQ(watch_drop(ours, corners, drop).fate(), Fate::miss);
  // MuJoCo's scene has no ground: outside of the net and below its rim is enough.
  EXPECT_EQ(watch_drop(theirs, corners, drop).fate(), Fate::miss);
}

INSTANTIATE_TEST_SUITE_P(Physics, TwoEngines, ::testing::Values(3, 4, 6));

}  // namespace
}  // namespace seine::sim
