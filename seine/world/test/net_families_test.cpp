#include "seine/world/net_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/world/check.hpp"
#include "seine/world/passage.hpp"

namespace seine::world {
namespace {

using geom::Vec2;

constexpr std::uint64_t kInstances = 200;
constexpr double kPi = std::numbers::pi;

std::string complaints(const Scenario& scenario) {
  std::string all;
  for (const std::string& complaint : check(scenario, StaticMap(scenario))) all += complaint + "\n";
  return all;
}

std::vector<Vec2> corners(const Scenario& s) {
  std::vector<Vec2> at;
  for (std::size_t k = 0; k < s.robots.size(); ++k)
    at.push_back(s.robots[k].start * s.net->attachments[k].at);
  return at;
}

Vec2 middle(const Scenario& s) {
  Vec2 sum;
  for (const Vec2 corner : corners(s)) sum += corner;
  return sum / static_cast<double>(s.robots.size());
}

int team_of(std::uint64_t seed) {
  constexpr std::array kTeams{3, 4, 6, 8};
  return kTeams[seed % kTeams.size()];
}

void expect_team_at_rest(const Scenario& s) {
  EXPECT_EQ(complaints(s), "") << s.name;
  EXPECT_NEAR(net::opening(*s.net, corners(s)), 0.86, 1e-9) << s.name;
  for (const Robot& robot : s.robots) {
    EXPECT_EQ(robot.start.heading, s.robots[0].start.heading);
    EXPECT_EQ(robot.start_speed, 0.0);
    EXPECT_FALSE(robot.goal.has_value());
  }
}

TEST(Throw, KeepsWhatItPromises) {
  int behind = 0, low = 0, all = 0;
  for (std::uint64_t seed = 0; seed < kInstances; ++seed) {
    const Scenario s = throw_scene(team_of(seed), seed);
    expect_team_at_rest(s);
    ASSERT_EQ(s.targets.size(), 1U);
    const auto crossing = net::Flight(s.targets[0]).crossing(s.net->rim());
    ASSERT_TRUE(crossing.has_value());
    const net::FlightState& state = crossing->state;
    const Vec2 way = state.position.ground() - middle(s);
    const double distance = geom::norm(way);
    EXPECT_GE(distance, 1.0 - 1e-9);
    EXPECT_LE(distance, 5.0 + 1e-9);
    behind += std::abs(geom::wrap_angle(std::atan2(way.y, way.x) - s.robots[0].start.heading)) > 0.8 + 1e-9;
    EXPECT_LE(geom::norm(state.velocity), 10.5 + 1e-9);
    EXPECT_LE(std::atan2(geom::norm(state.velocity.ground()), -state.velocity.z), 42.0 * kPi / 180.0 + 1e-9);
    EXPECT_GE(s.targets[0].time, -1e-9);
    EXPECT_LE(state.time - s.targets[0].time, 1.8 + 1e-9);
    EXPECT_GE(s.targets[0].position.z, 1.2 - 1e-9);
    const double dash =
        distance <= 2.5 * 2.5 / 6.0 ? std::sqrt(2.0 * distance / 3.0) : distance / 2.5 + 2.5 / 6.0;
    EXPECT_GE(state.time, 1.15 * dash - 1e-9);
    const double carry = geom::norm(s.delivery->center - state.position.ground());
    EXPECT_GE(carry, 5.0 - 1e-9);
    EXPECT_LE(carry, 9.0 + 1e-9);
    EXPECT_LE(s.obstacles.size(), 8U);
    for (const Obstacle& obstacle : s.obstacles) {
      ++all, low += !std::isinf(obstacle.height);
      EXPECT_TRUE(std::isinf(obstacle.height) || (obstacle.height >= 0.1 && obstacle.height <= 0.2));
      for (const Vec2 vertex : std::get<0>(obstacle.shape)) {
        EXPECT_GE(geom::norm(vertex - state.position.ground()), 1.6);
        EXPECT_GE(geom::norm(vertex - middle(s)), 1.8);
        EXPECT_GE(geom::norm(vertex - s.delivery->center), 1.8);
      }
    }
  }
  EXPECT_NEAR(behind / double(kInstances), (1.0 / 3.0) * (1.0 - 0.8 / kPi), 0.08);
  EXPECT_NEAR(low / double(all), 1.0 / 3.0, 0.07);
}

// There are a net, a place and a way to drive for which all rules of a catch hold.
TEST(Throw, CanBeCaught) {
  for (std::uint64_t seed = 0; seed < kInstances; ++seed) {
    const Scenario s = throw_scene(team_of(seed), seed);
    const net::Target& target = s.targets[0];
    const auto crossing = net::Flight(target).crossing(s.net->rim());
    const Vec2 from = middle(s), at = crossing->state.position.ground();
    const Vec2 direction = (at - from) / geom::norm(at - from);
    bool caught = false;
    for (double speed = 0.0; speed <= 2.5 && !caught; speed += 0.25) {
      for (double scale = 0.88; scale <= 0.941 && !caught; scale += 0.01) {
        for (int place = 0; place < 100 && !caught; ++place) {
          const Vec2 offset = 0.008 * place * geom::unit(2.4 * place) + at - from;
          std::vector<Vec2> hold;
          for (const Vec2 corner : corners(s)) hold.push_back(from + scale / 0.86 * (corner - from) + offset);
          const net::Catch c = net::measure_catch(*s.net, target, *crossing, hold, {speed * direction, {}});
          caught = c.rim_margin >= net::kRimMargin && c.contact_margin >= net::kContactMargin &&
                   c.angle <= net::kMaxAngle && c.bottom >= s.net->clearance &&
                   c.speed <= net::speed_limit(c.depth, target.radius, s.net->rebound);
        }
      }
    }
    EXPECT_TRUE(caught) << s.name;
  }
}

TEST(Throw, DenseMeansTenToTwentyTwoObstaclesAndAWayThrough) {
  for (std::uint64_t seed = 0; seed < kInstances; ++seed) {
    const Scenario s = throw_scene(team_of(seed), seed, Clutteredness::dense);
    EXPECT_EQ(complaints(s), "") << s.name;
    EXPECT_GE(s.obstacles.size(), 10U);
    EXPECT_LE(s.obstacles.size(), 22U);
  }
}

bool same(const Scenario& a, const Scenario& b) {
  bool equal = a.obstacles.size() == b.obstacles.size() && a.bounds.low == b.bounds.low;
  for (std::size_t k = 0; k < a.robots.size(); ++k) equal = equal && a.robots[k].start == b.robots[k].start;
  for (std::size_t k = 0; equal && k < a.obstacles.size(); ++k)
    equal = std::get<0>(a.obstacles[k].shape) == std::get<0>(b.obstacles[k].shape);
  for (std::size_t k = 0; k < a.targets.size(); ++k)
    equal = equal && a.targets[k].position == b.targets[k].position &&
            a.targets[k].velocity == b.targets[k].velocity;
  return equal && a.delivery->center == b.delivery->center;
}

TEST(NetFamilies, TheSeedDecidesEverything) {
  for (const int robots : {3, 4, 5, 6, 7, 8}) {
    EXPECT_TRUE(same(throw_scene(robots, 5), throw_scene(robots, 5)));
    EXPECT_FALSE(same(throw_scene(robots, 5), throw_scene(robots, 6)));
    EXPECT_TRUE(same(gap_scene(robots, 5), gap_scene(robots, 5)));
    EXPECT_FALSE(same(gap_scene(robots, 5), gap_scene(robots, 6)));
  }
}

TEST(Gap, IsTheOnlyWayAndAsWideAsAsked) {
  for (std::uint64_t seed = 0; seed < kInstances; ++seed) {
    const double width = 1.9 + 0.1 * static_cast<double>(seed % 8);
    const Scenario s = gap_scene(team_of(seed), seed, width);
    expect_team_at_rest(s);
    EXPECT_TRUE(s.payload.has_value());
    EXPECT_TRUE(s.targets.empty());
    ASSERT_EQ(s.obstacles.size(), 2U);
    const geom::Box below = geom::bounding_box(std::get<0>(s.obstacles[0].shape));
    const geom::Box above = geom::bounding_box(std::get<0>(s.obstacles[1].shape));
    EXPECT_NEAR(above.low.y - below.high.y, width, 1e-12);
    EXPECT_EQ(below.low.y, s.bounds.low.y);
    EXPECT_EQ(above.high.y, s.bounds.high.y);
    EXPECT_LT(middle(s).x, below.low.x);
    EXPECT_GT(s.delivery->center.x, below.high.x);
  }
}

TEST(NetFamilies, NonsenseIsRefused) {
  EXPECT_THROW(throw_scene(2, 1), InputError);
  EXPECT_THROW(throw_scene(9, 1), InputError);
  EXPECT_THROW(gap_scene(0, 1), InputError);
  EXPECT_THROW(gap_scene(4, 1, 0.5), InputError);
  EXPECT_THROW(gap_scene(4, 1, std::nan("")), InputError);
}

TEST(Passage, IsFoundWhereTheDiscFits) {
  const geom::Box room{{-5.0, -5.0}, {5.0, 5.0}};
  std::vector<Clutter> wall;
  for (double y = -5.0; y < 5.1; y += 0.5)
    if (std::abs(y) > 1.4) wall.push_back({{0.0, y}, 0.3});  // open from −1.2 to 1.2
  EXPECT_TRUE(passage(wall, room, {-3.0, 2.0}, {3.0, -2.0}, 1.1));
  EXPECT_FALSE(passage(wall, room, {-3.0, 2.0}, {3.0, -2.0}, 1.3));
  EXPECT_TRUE(passage(wall, room, {-3.0, 2.0}, {-3.0, -2.0}, 1.3));
  EXPECT_FALSE(passage(wall, room, {-0.5, 2.0}, {-3.0, -2.0}, 1.3));  // stuck where it begins
}

}  // namespace
}  // namespace seine::world
