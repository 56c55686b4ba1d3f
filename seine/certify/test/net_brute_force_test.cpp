// The certificate of a net against a 10 kHz look at the same plans, with limits just around what that look
// finds.
#include <gtest/gtest.h>

#include "seine/base/effort.hpp"
#include "seine/certify/height.hpp"
#include "seine/certify/test/brute_force.hpp"
#include "seine/certify/test/net_plans.hpp"
#include "seine/certify/tolerances.hpp"

namespace seine::certify::test {
namespace {

constexpr int kPlans = effort(20, 3), kFewPlans = effort(8, 1);
// A plan with this much room must hold, m; with that much too little it must not.
constexpr double kClean = 1e-3, kBroken = 1.5e-4;

Rng seeded(std::uint64_t seed) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  return Rng(seed);
}

Motion random_motion(Rng& rng) {
  return {.corners = 3 + rng.below(4),
          .radius = rng.uniform(1.0, 1.5),
          .scale = rng.uniform(0.8, 0.95),
          .deform = rng.uniform(0.0, 0.15),
          .duration = rng.uniform(0.8, 1.6),
          .piece_length = rng.uniform(0.5, 1.5)};
}

/// The verdict without what the loaded ones of these plans do on purpose: they brake harder than a payload
/// may be braked.
Certificate judged(const NetTeam& team) {
  Certificate certificate = team.judge();
  if (!team.scenario.payload) return certificate;
  std::erase_if(certificate.violations, [](const Violation& v) { return v.kind == Kind::braking; });
  certificate.holds = certificate.violations.empty();
  return certificate;
}

/// Judges with a limit on either side of what brute force found.
void expect_between(NetTeam& team, Kind kind, const std::function<void(double room)>& set) {
  set(kClean);
  const Certificate clean = judged(team);
  EXPECT_TRUE(clean.holds) << summary(clean);
  set(-kBroken);
  const Certificate broken = judged(team);
  EXPECT_TRUE(!broken.holds && breaks(broken, kind)) << summary(broken);
  for (const Violation& v : broken.violations) EXPECT_EQ(v.kind, kind) << summary(broken);
}

TEST(NetAgainstBruteForce, Stretch) {
  Rng rng = seeded(31);
  for (int i = 0; i < kPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    NetTeam team = random_team(rng, random_motion(rng));
    const Grid grid(team);
    double most = 0.0, length = 1.0;  // the pair nearest to its limit
    for (std::size_t a = 0; a < team.net().size(); ++a) {
      for (std::size_t b = a + 1; b < team.net().size(); ++b) {
        const double rest = geom::norm(team.net().rest[a] - team.net().rest[b]);
        const double apart = -grid.least([&](const auto& at, double) { return -geom::norm(at[a] - at[b]); });
        if (apart / rest > most) most = apart / rest, length = rest;
      }
    }
    expect_between(team, Kind::net_stretch, [&](double room) { team.net().stretch = most + room / length; });
    team.net().stretch = most + 0.01;
    EXPECT_NEAR(team.judge().net.stretch.clearance, 0.01 * length, 0.01);
  }
}

/// The same team with car k's whole way moved.
void move_car(NetTeam& team, std::size_t k, Vec2 by) {
  for (auto& piece : team.plan.robots[k].segments.front().curve) piece[0][0] += by.x, piece[1][0] += by.y;
  team.scenario.robots[k].start = team.plan.robots[k].at(0.0).pose;
  team.scenario.robots[k].goal = team.plan.robots[k].at(team.plan.makespan()).pose;
}

TEST(NetAgainstBruteForce, Convexity) {
  Rng rng = seeded(32);
  int tried = 0;
  for (int i = 0; i < kPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    Motion motion = random_motion(rng);
    motion.deform *= 0.3;
    const NetTeam whole = random_team(rng, motion);
    const Grid grid(whole);
    // One car moves inwards until the ring is flat there.
    const auto k = static_cast<std::size_t>(rng.below(motion.corners));
    const Vec2 inwards = -motion.scale * whole.scenario.net->rest[k];
    const auto room = [&](double share) {
      const auto moved = [&](std::vector<Vec2> at, double) {
        at[k] += share * inwards;
        return least_corner(at);
      };
      return grid.least(moved, 10) - net::kConvexMargin;
    };
    if (room(0.0) < 2.0 * kClean) continue;
    ++tried;
    NetTeam team = whole;
    expect_between(team, Kind::net_topology, [&](double wanted) {
      double low = 0.0, high = 2.0;
      while (high - low > 1e-6) {
        const double middle = 0.5 * (low + high);
        (room(middle) > wanted ? low : high) = middle;
      }
      team = whole;
      move_car(team, k, low * inwards);
    });
  }
  EXPECT_GT(tried, kPlans / 2);
}

TEST(NetAgainstBruteForce, Holding) {
  Rng rng = seeded(39);
  int tried = 0;
  for (int i = 0; i < kPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    Motion motion = random_motion(rng);
    motion.deform = 0.1;
    NetTeam team = random_team(rng, motion);
    team.scenario.payload = net::Payload{};
    const std::vector<Vec2> rest = team.net().rest;
    const Grid grid(team);
    // A larger cloth has more slack at every side: where the sides are not alike, that helps or harms.
    const auto reserve = [&](double scale, std::size_t stride) {
      for (std::size_t k = 0; k < rest.size(); ++k) team.net().rest[k] = scale * rest[k];
      return grid.least([&](const auto& at, double) { return net::holding_reserve(team.net(), at); }, stride);
    };
    constexpr double kSmallest = 0.8, kLargest = 1.5;
    if (reserve(kSmallest, 10) > 0.0 || reserve(kLargest, 10) < 0.0) continue;
    ++tried;
    expect_between(team, Kind::net_holding, [&](double wanted) {
      double a = kSmallest, b = kLargest;
      while (b - a > 1e-7) {
        const double middle = 0.5 * (a + b);
        (reserve(middle, 10) < wanted ? a : b) = middle;
      }
    });
  }
  EXPECT_GT(tried, kPlans / 2);
}

TEST(NetAgainstBruteForce, Opening) {
  Rng rng = seeded(33);
  for (int i = 0; i < kPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    Motion motion = random_motion(rng);
    motion.scale = 0.95;
    motion.duration = 2.0;
    NetTeam team = random_team(rng, motion);
    const double time = rng.uniform(0.0, 0.9);
    const Grid grid(team, time, time + net::kHoldTime - 1e-9);
    const std::vector<Vec2> then = grid.at(time);
    Vec2 middle;
    for (const Vec2 p : then) middle += p / static_cast<double>(then.size());
    team.scenario.targets = {drop(middle, time, 5.0)};
    const double least = grid.least([&](const auto& at, double) { return net::opening(team.net(), at); });
    const std::vector<Vec2> rest = team.net().rest;
    const auto set = [&](double room) {
      const double factor = least / (net::kHeldOpening + room);
      for (std::size_t k = 0; k < rest.size(); ++k) team.net().rest[k] = factor * rest[k];
    };
    // The opening at the catch is another rule: only this one counts here.
    set(kClean);
    EXPECT_FALSE(breaks(team.judge(), Kind::net_opening)) << summary(team.judge());
    set(-kBroken);
    EXPECT_TRUE(breaks(team.judge(), Kind::net_opening)) << summary(team.judge());
  }
}

TEST(NetAgainstBruteForce, Drag) {
  Rng rng = seeded(34);
  for (int i = 0; i < kPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    NetTeam team = random_team(rng, random_motion(rng));
    const bool loaded = i % 2 == 0;
    if (loaded) team.scenario.payload = net::Payload{};
    const Grid grid(team);
    const double reserve =
        grid.least([&](const auto& at, double) { return net::holding_reserve(team.net(), at); }, 10);
    if (loaded && reserve < 0.0) continue;
    const double lowest =
        grid.least([&](const auto& at, double) { return 1.0 - net::loaded_depth(team.net(), at); }, 20);
    expect_between(team, Kind::net_drag, [&](double room) { team.net().clearance = lowest - room; });
    team.net().clearance = lowest - 0.1;
    EXPECT_NEAR(team.judge().net.ground.clearance, 0.1, kHeightResolution + 1e-6);
    if (!loaded) continue;
    EXPECT_NEAR(team.judge().net.holding.clearance, reserve, kReserveResolution + 1e-6);
  }
}

world::Obstacle random_obstacle(Rng& rng, const Vec2 middle, bool moving) {
  const double radius = rng.uniform(0.05, 0.3);
  const geom::Pose2 at{middle.x + rng.uniform(-2.5, 2.5), middle.y + rng.uniform(-2.5, 2.5),
                       rng.uniform(-3, 3)};
  world::Obstacle obstacle{.name = "", .shape = regular(3 + rng.below(3), radius), .motion = {}};
  if (rng.below(2) == 0) obstacle.height = rng.uniform(0.0, 0.6);
  if (moving) {
    obstacle.motion = {
        {rng.uniform(0.0, 0.5), at},
        {rng.uniform(0.6, 2.0), {at.x + rng.uniform(-1, 1), at.y + rng.uniform(-1, 1), rng.uniform(-3, 3)}}};
  } else {
    for (Vec2& p : std::get<std::vector<Vec2>>(obstacle.shape)) p = at * p;
  }
  return obstacle;
}

/// What is left of the net over or beside the obstacle, from its definition.
double room_over(const NetTeam& team, const world::Obstacle& obstacle, const std::vector<Vec2>& at,
                 double t) {
  const geom::Convex body{std::get<std::vector<Vec2>>(obstacle.shape), 0.0};
  const geom::Convex there = obstacle.motion.empty() ? body : geom::placed(body, pose_of(obstacle, t));
  const double beside = geom::distance(at, there.core);
  if (std::isinf(obstacle.height) || beside > 0.3) return beside;
  const net::Net& net = *team.scenario.net;
  return std::max(beside, 1.0 - net::loaded_depth(net, at) - obstacle.height - net.clearance);
}

TEST(NetAgainstBruteForce, Obstacles) {
  Rng rng = seeded(35);
  int clean = 0, broken = 0;
  for (int i = 0; i < 3 * kFewPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    NetTeam team = random_team(rng, random_motion(rng));
    team.scenario.payload = net::Payload{};
    team.net().clearance = 0.05 - 0.3 * rng.below(2);
    Vec2 middle;
    for (const Vec2 p : Grid(team, 0.0, 1e-4).at(0.5)) middle += p / static_cast<double>(team.net().size());
    for (int o = 0; o < 3; ++o) team.scenario.obstacles.push_back(random_obstacle(rng, middle, o == 2));
    double end = team.plan.makespan();
    if (!team.scenario.obstacles[2].motion.empty())
      end = std::max(end, team.scenario.obstacles[2].motion.back().t);
    const Grid grid(team, 0.0, end);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& obstacle : team.scenario.obstacles) {
      least = std::min(
          least, grid.least([&](const auto& at, double t) { return room_over(team, obstacle, at, t); }, 10));
    }
    const Certificate certificate = team.judge();
    if (least > kClean) {
      EXPECT_FALSE(breaks(certificate, Kind::net_obstacle)) << least << summary(certificate);
      EXPECT_FALSE(breaks(certificate, Kind::undecided)) << least << summary(certificate);
      ++clean;
    } else if (least < -kBroken) {
      EXPECT_TRUE(breaks(certificate, Kind::net_obstacle)) << least << summary(certificate);
      ++broken;
    }
    if (least < kNetSearch) {
      EXPECT_NEAR(certificate.net.obstacles.clearance, least, kHeightResolution + 1e-4);
    }
  }
  std::printf("%d clean, %d broken\n", clean, broken);
  EXPECT_GT(clean, kFewPlans / 3);
  EXPECT_GT(broken, kFewPlans / 3);
}

/// A place that the net passes by at more than 0.1 m, and how near it comes.
std::pair<Vec2, double> place_beside(Rng& rng, const Grid& grid, const geom::Pose2& drift) {
  for (;;) {
    const Vec2 near = grid.at(rng.uniform(0.0, 1.0)).front();
    const Vec2 place = near + rng.uniform(0.1, 0.5) * geom::unit(rng.uniform(-3.0, 3.0));
    const auto distance = [&](std::size_t stride) {
      return grid.least(
          [&](const auto& at, double t) {
            const Vec2 now = place + t * drift.position();
            return geom::distance(at, std::span(&now, 1));
          },
          stride);
    };
    if (distance(200) > 0.1) return {place, distance(10)};
  }
}

/// Poles and stumps that leave exactly a millimetre, or take a little too much; while another one leaves
/// less, so that nothing is looked at closely only because it is the closest.
TEST(NetAgainstBruteForce, ObstaclesAtTheLimit) {
  Rng rng = seeded(36);
  for (int i = 0; i < kFewPlans; ++i) {
    SCOPED_TRACE("plan " + std::to_string(i));
    NetTeam team = random_team(rng, random_motion(rng));
    const Grid grid(team);
    const auto [decoy, room_of_decoy] = place_beside(rng, grid, {});
    team.scenario.obstacles = {
        {.name = "", .shape = world::Circle{decoy, room_of_decoy - 1e-4}, .motion = {}}};
    team.scenario.obstacles.push_back(team.scenario.obstacles.front());
    world::Obstacle& tested = team.scenario.obstacles.back();
    // Beside the net, standing still or moving.
    const bool moves = i % 2 == 0;
    const geom::Pose2 drift{moves ? rng.uniform(-0.5, 0.5) : 0.0, moves ? rng.uniform(-0.5, 0.5) : 0.0, 0.0};
    const auto [place, distance] = place_beside(rng, grid, drift);
    const double end = team.plan.makespan();
    expect_between(team, Kind::net_obstacle, [&](double room) {
      tested.shape = world::Circle{moves ? Vec2{} : place, distance - room};
      const Vec2 last = place + end * drift.position();
      if (moves) tested.motion = {{0.0, {place.x, place.y, 0.0}}, {end, {last.x, last.y, 0.0}}};
    });
    // Under the net.
    const Vec2 stump = grid.at(0.0).front();
    tested = {.name = "", .shape = world::Circle{stump, 0.5}, .motion = {}};
    team.net().clearance = 0.05;
    const double lowest = grid.least(
        [&](const auto& at, double) {
          if (geom::distance(at, std::vector<Vec2>{stump}) >= 0.5) return 10.0;
          return 1.0 - net::loaded_depth(team.net(), at);
        },
        10);
    if (lowest < 0.2) continue;
    expect_between(team, Kind::net_obstacle, [&](double room) { tested.height = lowest - 0.05 - room; });
  }
}

TEST(NetHeight, GrowsNoFasterThanItsBound) {
  Rng rng = seeded(37);
  for (int i = 0; i < 3000; ++i) {
    const int corners = 3 + rng.below(4);
    net::Net net;
    net.rest = regular(corners, 1.4, rng.uniform(0.0, 1.0));
    for (Vec2& p : net.rest) p += {rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)};
    net.attachments.assign(net.rest.size(), {});
    std::vector<Vec2> a, b;
    for (const Vec2 p : net.rest) {
      a.push_back(rng.uniform(0.6, 0.95) * p);
      b.push_back(a.back() + rng.uniform(0.0, 0.2) * geom::unit(rng.uniform(-3.0, 3.0)));
    }
    double decrease = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t j = 0; j < k; ++j)
        decrease = std::max(decrease, geom::squared_norm(a[k] - a[j]) - geom::squared_norm(b[k] - b[j]));
    }
    const double at_a = net::loaded_depth(net, a), at_b = net::loaded_depth(net, b);
    EXPECT_LE(at_b * at_b, at_a * at_a + 0.5 * (1.0 - 1.0 / corners) * decrease + 1e-8);
  }
}

TEST(NetCertificate, IsTheSameForAnyNumberOfThreads) {
  Rng rng = seeded(38);
  for (int i = 0; i < 5; ++i) {
    NetTeam team = random_team(rng, random_motion(rng));
    team.scenario.payload = net::Payload{};
    team.net().stretch = 0.9;
    team.net().clearance = 0.4;
    const Certificate one = team.judge({.threads = 1, .deadline = {}});
    const Certificate four = team.judge({.threads = 4, .deadline = {}});
    EXPECT_EQ(summary(one), summary(four));
    EXPECT_EQ(one.net.stretch.clearance, four.net.stretch.clearance);
    EXPECT_EQ(one.net.ground.clearance, four.net.ground.clearance);
    EXPECT_EQ(one.net.obstacles.clearance, four.net.obstacles.clearance);
  }
}

}  // namespace
}  // namespace seine::certify::test
