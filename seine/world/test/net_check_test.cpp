#include "seine/world/net_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/net/shape.hpp"
#include "seine/world/check.hpp"

namespace seine::world {
namespace {

using geom::Vec2;

// Four cars that look outwards and hold a square net of 2 m at 86 %, with a throw and a delivery.
Scenario good() {
  Scenario s;
  s.bounds = {{-10.0, -10.0}, {10.0, 10.0}};
  s.models.push_back(
      {.name = "default", .footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1), .limits = {}});
  net::Net net;
  for (int k = 0; k < 4; ++k) {
    const double angle = 0.5 * std::numbers::pi * k;
    const Vec2 corner = std::sqrt(2.0) * geom::unit(angle);
    net.rest.push_back(corner);
    net.attachments.push_back({{0.2, 0.0}, 1.0});
    const Vec2 rear = 0.86 * corner - Vec2{0.2, 0.0};
    s.robots.push_back(
        {.name = "car" + std::to_string(k), .start = {rear.x, rear.y, 0.0}, .goal = std::nullopt});
  }
  s.net = net;
  net::Target target;
  target.position = {2.0, 0.0, 3.0};
  s.targets.push_back(target);
  s.delivery = net::Delivery{{5.0, 1.0}, 0.5, std::nullopt};
  return s;
}

void give_goals(Scenario& s, Vec2 shift) {
  for (Robot& robot : s.robots)
    robot.goal = geom::Pose2{robot.start.x + shift.x, robot.start.y + shift.y, robot.start.heading};
}

// Exactly one complaint, and it holds every one of `words`.
void expect_one(const std::function<void(Scenario&)>& spoil, const std::vector<std::string>& words) {
  Scenario scenario = good();
  spoil(scenario);
  const std::vector<std::string> found = check(scenario, StaticMap(scenario));
  ASSERT_EQ(found.size(), 1U) << (found.empty() ? "no complaint about " + words[0]
                                                : found[0] + " | " + found.back());
  for (const std::string& word : words) EXPECT_NE(found[0].find(word), std::string::npos) << found[0];
}

std::vector<Vec2> square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST(CheckNet, AGoodTaskHasNoComplaint) {
  Scenario s = good();
  EXPECT_EQ(check(s, StaticMap(s)), std::vector<std::string>{});
  give_goals(s, {5.0, 1.2});
  EXPECT_EQ(check(s, StaticMap(s)), std::vector<std::string>{});
  s.targets.clear();
  s.payload = net::Payload{};
  EXPECT_EQ(check(s, StaticMap(s)), std::vector<std::string>{});
}

TEST(CheckNet, ANetThatMakesNoSense) {
  expect_one([](Scenario& s) { s.net->rest.pop_back(); }, {"3 corners", "4 attachments", "4 robots"});
  expect_one([](Scenario& s) { std::reverse(s.net->rest.begin(), s.net->rest.end()); }, {"clockwise"});
  expect_one([](Scenario& s) { s.net->rest[0] = {-1.0, 0.1}; }, {"net at rest is not"});
  expect_one([](Scenario& s) { s.net->stretch = 1.0; }, {"stretch limit is 1"});
  expect_one([](Scenario& s) { s.net->rebound = 0.0; }, {"rebound is 0"});
  expect_one([](Scenario& s) { s.net->clearance = -0.1; }, {"clearance is -0.1"});
  expect_one([](Scenario& s) { s.net->attachments[2].height = 0.9; }, {"at 1 m and at 0.9 m", "one height"});
  expect_one([](Scenario& s) { s.payload = net::Payload{}; }, {"both a payload and targets"});
}

TEST(CheckNet, AStartThatTheNetForbids) {
  expect_one([](Scenario& s) { s.robots[0].start.x += 0.3; },
             {"car0 and car1 hold the net 1.94374 m apart at the start", "limit of 1.9 m", "0.95 of 2 m"});
  // car0 pulled in through the line from car3 to car1.
  expect_one([](Scenario& s) { s.robots[0].start.x = -0.45; },
             {"at the start is not convex", "car3 holds it 0.48976 m outside the edge from car0 to car1",
              "expected 0.05 m inside"});
  expect_one(
      [](Scenario& s) {
        std::swap(s.robots[1].start, s.robots[3].start);
        s.delivery.reset();
      },
      {"not convex and counter-clockwise"});
}

TEST(CheckNet, ANetThatDrags) {
  // Scale 0.86 leaves 0.28 m; the empty net is taken to hang as deep as under a load.
  expect_one(
      [](Scenario& s) {
        for (auto& a : s.net->attachments) a.height = 0.75;
        s.targets.clear();
        s.payload = net::Payload{};
      },
      {"the loaded net at the start hangs 0.721", "below its rim at 0.75 m", "clearance of 0.05 m"});
  expect_one(
      [](Scenario& s) {
        for (auto& a : s.net->attachments) a.height = 0.5;
      },
      {"the net at the start hangs 0.721", "nearer to the ground"});
}

TEST(CheckNet, WhatIsUnderTheNet) {
  const auto block = [](double height) {
    return [height](Scenario& s) {
      s.obstacles.push_back(
          {.name = "block", .shape = square(0.3, 0.0, 0.1), .height = height, .motion = {}});
    };
  };
  expect_one(block(std::numeric_limits<double>::infinity()),
             {"block stands inside the net at the start", "infinitely tall", "rim is at 1 m"});
  expect_one(block(1.0), {"block stands inside the net at the start: it is 1 m tall"});
  expect_one(block(0.5), {"hangs down to 0.278", "over block, which is 0.5 m tall", "clearance of 0.05 m"});
  Scenario low = good();
  block(0.2)(low);
  EXPECT_EQ(check(low, StaticMap(low)), std::vector<std::string>{});
  low.targets.clear();
  low.payload = net::Payload{};
  EXPECT_EQ(check(low, StaticMap(low)), std::vector<std::string>{});
  low.obstacles.back().height = 0.25;
  EXPECT_EQ(check(low, StaticMap(low)).size(), 1U);
  expect_one(
      [](Scenario& s) {
        s.obstacles.push_back(
            {.name = "cart",
             .shape = Circle{{}, 0.05},
             .motion = {{-1.0, {-1.0, 0.0, 0.0}}, {1.0, {1.0, 0.0, 0.0}}, {9.0, {9.0, 9.0, 0.0}}}});
      },
      {"cart (moving) stands inside the net at the start"});
}

TEST(CheckNet, TargetsThatCannotBeCaught) {
  expect_one([](Scenario& s) { s.targets[0].position.z = 0.4; },
             {"target 1 is released 0.6 m below the rim of the net at 1 m and never falls through it"});
  expect_one(
      [](Scenario& s) {
        s.targets.push_back(s.targets[0]);
        s.targets[1].time = -2.0;
      },
      {"target 2 falls through the rim of the net at t = -1.36", "before the plan begins"});
  expect_one([](Scenario& s) { s.targets[0].mass = -1.0; }, {"mass of target 1 is -1"});
  expect_one([](Scenario& s) { s.targets[0].radius = 0.0; }, {"radius of target 1 is 0"});
  Scenario thrown = good();
  thrown.targets[0].position.z = 0.4;
  thrown.targets[0].velocity.z = 5.0;
  EXPECT_EQ(check(thrown, StaticMap(thrown)), std::vector<std::string>{});
}

TEST(CheckNet, APayloadThatIsWiderThanTheNet) {
  const auto carry = [](double radius, double mass) {
    return [radius, mass](Scenario& s) {
      s.targets.clear();
      s.payload = net::Payload{radius, mass};
    };
  };
  expect_one(carry(50.0, 0.25), {"payload has a radius of 50 m, wider than the net"});
  expect_one(carry(0.1, -1.0), {"mass of the payload is -1"});
  Scenario s = good();
  const double widest = net::inradius(s.net->rest);
  carry(widest - 1e-6, 0.25)(s);
  EXPECT_EQ(check(s, StaticMap(s)), std::vector<std::string>{});
  expect_one(carry(widest + 1e-6, 0.25), {"wider than the net"});
}

TEST(CheckNet, ATargetThatFliesIntoSomething) {
  const auto with_wall = [](double height, double x) {
    return [height, x](Scenario& s) {
      s.targets[0].velocity = {-2.0, 0.0, 1.0};  // passes x = 1.2 at t = 0.4 s, 2.6 m above the ground
      s.obstacles.push_back({.name = "wall", .shape = square(x, 2.0, 0.4), .height = height, .motion = {}});
      s.obstacles.back().shape = std::vector<Vec2>{{x, -0.2}, {x + 0.1, -0.2}, {x + 0.1, 0.2}, {x, 0.2}};
    };
  };
  expect_one(with_wall(3.0, 1.6), {"target 1 flies into wall at t = 0.1", "it is 3 m tall"});
  Scenario s = good();
  with_wall(2.0, 1.6)(s);
  EXPECT_EQ(check(s, StaticMap(s)), std::vector<std::string>{});
}

TEST(CheckNet, ADeliveryThatContradictsTheRest) {
  expect_one([](Scenario& s) { s.delivery->center = {10.5, 0.0}; }, {"delivery at (10.5, 0) lies outside"});
  expect_one(
      [](Scenario& s) {
        give_goals(s, {5.0, 2.0});
      },
      {"middle of the net to (5, 2), 1 m from the delivery at (5, 1), beyond its radius of 0.5 m"});
  expect_one(
      [](Scenario& s) {
        give_goals(s, {5.0, 1.0});
        s.delivery->heading = 0.0;
        s.robots[2].goal->heading = 0.2;
      },
      {"goal of car2 has heading 0.2, the delivery asks for 0"});
  expect_one(
      [](Scenario& s) {
        s.net.reset();
        give_goals(s, {5.0, 1.0});
      },
      {"but no net"});
  expect_one(
      [](Scenario& s) {
        give_goals(s, {5.0, 1.0});
        s.robots[0].goal->x += 0.3;
      },
      {"car0 and car1 hold the net", "at the goals"});
}

TEST(CheckNet, ACovarianceIsOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [i, j, value] :
       {std::tuple{0, 0, nan}, {0, 0, -1.0}, {5, 5, -1e-3}, {0, 1, 0.5}, {2, 3, nan}}) {
    Scenario s = good();
    s.targets[0].covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = value;
    EXPECT_THROW(expect_numbers(s), InputError) << i << j << value;
  }
  Scenario s = good();
  auto& c = s.targets[0].covariance;
  for (std::size_t k = 0; k < 6; ++k) c[k][k] = 0.01;
  c[0][3] = c[3][0] = 0.0099;
  EXPECT_NO_THROW(expect_numbers(s));
  c[0][3] = c[3][0] = 0.011;  // more than two variances allow
  EXPECT_THROW(expect_numbers(s), InputError);
  s = good();
  s.targets[0].position.z = nan;
  EXPECT_THROW(expect_numbers(s), InputError);
}

}  // namespace
}  // namespace seine::world
