// The engine against statics, momentum and free flight, which it does not contain as formulas.
#include "seine/sim/cord_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "seine/net/flight.hpp"
#include "seine/sim/drops.hpp"
#include "seine/sim/test/teams.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr std::uint64_t kSeed = 21;

CordNet net_of(const net::Net& net, const std::vector<Vec3>& corners) {
  return {net, corners, material_of_rebound(net.rebound)};
}

TEST(CordNet, AnObjectHangsWhereTheFormulaSays) {
  for (const int robots : teams()) {
    for (const double opening : {0.86, 0.95}) {
      const net::Net net = world::family_net(robots);
      const std::vector<Vec3> corners = held(net, opening);
      const double formula = net.rim() - net::loaded_depth(net, on_ground(corners));
      CordNet physics = net_of(net, corners);
      physics.add({.position = {0.05, 0.03, formula + 0.15}});
      physics.advance(corners, 3.0);
      const Ball& ball = physics.ball(0);
      EXPECT_NEAR(ball.position.z - ball.radius, formula, 0.03)
          << robots << " corners, " << opening << " open";
      EXPECT_LT(norm(ball.velocity), 0.05);
      EXPECT_LT(geom::norm(ball.position.ground()), 0.03);
    }
  }
}

TEST(CordNet, HangsAsTheFormulaSaysFromUnevenCorners) {
  Rng rng(kSeed);
  for (int round = 0; round < effort(4, 1); ++round) {
    const net::Net net = world::family_net(3 + round % 4);
    const double along = rng.uniform(0.84, 0.93), across = rng.uniform(0.84, 0.93);
    std::vector<Vec3> corners;
    for (const geom::Vec2 r : net.rest)
      corners.push_back(
          {along * r.x + rng.uniform(-0.05, 0.05), across * r.y + rng.uniform(-0.05, 0.05), 1.0});
    const Vec3 formula = net::equilibria(net.rest, on_ground(corners), net.rim()).front().position;
    CordNet physics = net_of(net, corners);
    physics.add({.position = formula + Vec3{0.0, 0.0, 0.2}});
    physics.advance(corners, 4.0);
    const Ball& ball = physics.ball(0);
    EXPECT_NEAR(ball.position.z - ball.radius, formula.z, 0.03) << "round " << round << ", seed " << kSeed;
  }
}

TEST(CordNet, CornersCarryTheWeight) {
  for (const int robots : teams()) {
    const net::Net net = world::family_net(robots);
    const std::vector<Vec3> corners = held(net, 0.9);
    CordNet physics = net_of(net, corners);
    physics.add({.position = {0.0, 0.0, 0.6}, .mass = 0.5});
    physics.advance(corners, 3.0);
    physics.advance(corners, 0.5);
    Vec3 sum;
    for (const Vec3 pull : physics.pulls()) sum += pull;
    double corner_share = 0.0;  // what rests on the masts themselves
    for (std::size_t k = 0; k < net.size(); ++k) corner_share += physics.mesh().share[k];
    const double weight = net::kGravity * (0.5 + 0.4 * (1.0 - corner_share));
    EXPECT_NEAR(sum.z, -weight, 0.02 * weight);
    EXPECT_NEAR(geom::norm(sum.ground()), 0.0, 0.02 * weight);
    for (std::size_t k = 0; k < net.size(); ++k)
      EXPECT_LT(geom::dot(physics.pulls()[k].ground(), corners[k].ground()), 0.0) << "inwards";
  }
}

TEST(CordNet, WhatAnObjectLosesTheCornersGet) {
  const net::Net net = world::family_net(4);
  const std::vector<Vec3> corners = held(net, 0.9);
  NetMaterial material = material_of_rebound(0.25);
  material.air = 0.0;
  CordNet physics(net, corners, material);
  const Ball thrown{.position = {0.1, -0.2, 1.3}, .velocity = {1.0, 0.5, -6.0}, .mass = 0.5};
  physics.add(thrown);
  const Vec3 before = thrown.mass * thrown.velocity;
  Vec3 given;
  double time = 0.0;
  for (; time < 1.5; time += 0.01) {
    physics.advance(corners, 0.01);
    for (const Vec3 pull : physics.pulls()) given += 0.01 * pull;
  }
  double net_mass = 0.0;
  for (std::size_t v = net.size(); v < physics.mesh().share.size(); ++v)
    net_mass += material.mass * physics.mesh().share[v];
  // The net hangs still before and after, so only the object's momentum changes, and both have weight.
  const Vec3 after = thrown.mass * physics.ball(0).velocity;
  const Vec3 lost = before - after + time * Vec3{0.0, 0.0, -net::kGravity * (thrown.mass + net_mass)};
  EXPECT_NEAR(norm(given - lost), 0.0, 0.15) << "of " << norm(before) << " N s";
}

TEST(CordNet, FreeFlightIsTheOneThatPlansAreMadeFor) {
  const net::Net net = world::family_net(3);
  const std::vector<Vec3> corners = held(net, 0.9);
  Rng rng(kSeed);
  for (int round = 0; round < 5; ++round) {
    net::Target target;
    target.position = {rng.uniform(3.0, 5.0), 0.0, 2.0};
    target.velocity = {rng.uniform(-4.0, 4.0), rng.uniform(0.0, 4.0), rng.uniform(2.0, 6.0)};
    target.drag = round == 0 ? 0.0 : rng.uniform(0.0, 0.15);
    CordNet physics = net_of(net, corners);
    physics.add(ball_of(target));
    physics.advance(corners, 0.7);
    const net::FlightState there = net::Flight(target).at(0.7);
    EXPECT_NEAR(norm(physics.ball(0).position - there.position), 0.0, 1e-4) << "seed " << kSeed;
    EXPECT_NEAR(norm(physics.ball(0).velocity - there.velocity), 0.0, 1e-3);
  }
}

TEST(CordNet, SameBitsEveryTime) {
  const net::Net net = world::family_net(6);
  const std::vector<Vec3> corners = held(net, 0.9);
  std::array<std::vector<Vec3>, 2> nodes;
  std::array<Vec3, 2> places;
  for (std::size_t run = 0; run < 2; ++run) {
    CordNet physics = net_of(net, corners);
    physics.add({.position = {0.2, 0.1, 1.3}, .velocity = {1.0, -1.0, -8.0}});
    for (int i = 0; i < 300; ++i) physics.advance(corners, 1e-3);
    nodes[run].assign(physics.nodes().begin(), physics.nodes().end());
    places[run] = physics.ball(0).position;
  }
  EXPECT_EQ(places[0], places[1]);
  EXPECT_EQ(nodes[0], nodes[1]);
}

TEST(CordNet, IsTheSameFromATrain) {
  const net::Net net = world::family_net(4);
  std::vector<Vec3> still = held(net, 0.9);
  const Vec3 drift{1.7, -1.1, 0.0};
  CordNet at_home = net_of(net, still);
  CordNet on_train = net_of(net, still);
  // The second net needs a moment to be as fast as its corners: objects come after it has swung out.
  std::vector<Vec3> moving = still;
  const auto ride = [&](double seconds) {
    for (Vec3& corner : moving) corner += seconds * drift;
    on_train.advance(moving, seconds);
  };
  ride(6.0);
  at_home.advance(still, 6.0);
  const Ball ball{.position = {0.1, 0.2, 1.2}, .velocity = {1.0, 0.0, -7.0}};
  Ball riding = ball;
  riding.position += 6.0 * drift;
  riding.velocity += drift;
  at_home.add(ball);
  on_train.add(riding);
  for (int i = 0; i < 400; ++i) {
    at_home.advance(still, 1e-3);
    ride(1e-3);
  }
  const Vec3 seen = on_train.ball(0).position + (-6.4) * drift;
  EXPECT_NEAR(norm(seen - at_home.ball(0).position), 0.0, 0.02);
}

TEST(CordNet, ObjectsDoNotShareAPlace) {
  const net::Net net = world::family_net(4);
  const std::vector<Vec3> corners = held(net, 0.9);
  CordNet physics = net_of(net, corners);
  physics.add({.position = {-0.2, 0.0, 0.9}});
  physics.add({.position = {0.2, 0.05, 0.9}, .radius = 0.1, .mass = 0.5});
  physics.advance(corners, 3.0);
  EXPECT_GE(norm(physics.ball(0).position - physics.ball(1).position), 0.18 - 5e-3);
  EXPECT_TRUE(physics.touching(0) && physics.touching(1));
}

TEST(CordNet, AnObjectBesideTheNetEndsOnTheGround) {
  const net::Net net = world::family_net(4);
  const std::vector<Vec3> corners = held(net, 0.9);
  CordNet physics = net_of(net, corners);
  physics.add({.position = {2.5, 0.0, 1.5}, .velocity = {0.5, 0.0, 0.0}});
  physics.advance(corners, 1.5);
  EXPECT_DOUBLE_EQ(physics.ball(0).position.z, 0.08);
  EXPECT_FALSE(physics.touching(0));
}

}  // namespace
}  // namespace seine::sim
