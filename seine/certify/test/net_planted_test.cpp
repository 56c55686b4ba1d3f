// Planted faults of a net: short ones, late ones, and shapes one forgets to look at.
#include <gtest/gtest.h>

#include "seine/base/error.hpp"
#include "seine/certify/test/brute_force.hpp"
#include "seine/certify/test/net_plans.hpp"

namespace seine::certify::test {
namespace {

void expect_only(const Certificate& certificate, Kind kind) {
  EXPECT_FALSE(certificate.holds);
  EXPECT_TRUE(breaks(certificate, kind)) << summary(certificate);
  for (const Violation& v : certificate.violations) EXPECT_EQ(v.kind, kind) << summary(certificate);
}

void expect_holds(const Certificate& certificate) {
  EXPECT_TRUE(certificate.holds) << summary(certificate);
}

std::vector<Vec2> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// Forwards and back again: at rest for an instant at the far end.
traj::RobotTrajectory there_and_back(const geom::Pose2& from, double length, double duration) {
  traj::RobotTrajectory way = straight(from, length, duration);
  const traj::RobotTrajectory back = straight(
      {from.x + length * std::cos(from.heading), from.y + length * std::sin(from.heading), from.heading},
      length, duration, -1);
  way.segments.push_back(back.segments.front());
  return way;
}

traj::RobotTrajectory after(double wait, traj::RobotTrajectory way) {
  way.segments.front().wait = wait;
  return way;
}

TEST(PlantedNet, StretchedByAMillimetreForAMillisecond) {
  // One car darts a metre out and back within 50 ms; it is furthest away for an instant that no grid of
  // 1 kHz meets.
  traj::TeamTrajectory plan{{parked({-2.0, -1.0, 0.0}), there_and_back({0.0, -1.0, 0.0}, 1.0, 0.0251),
                             parked({0.0, 1.0, 0.0}), parked({-2.0, 1.0, 0.0})}};
  NetTeam team = net_team(plan, {{-1.9, -1.6}, {1.7, -1.1}, {1.9, 1.6}, {-1.7, 1.1}}, {0.0, 0.0});
  const double diagonal = std::hypot(3.0, 2.0), rest = std::hypot(3.4, 2.2);
  const auto over = [&](double by) {
    team.net().stretch = (diagonal - by) / rest;
    return team.judge();
  };
  const Grid grid(team);
  const auto excess = [&](double t) { return geom::norm(grid.at(t)[1] - grid.at(t)[3]) - diagonal + 1e-3; };
  EXPECT_GT(excess(0.0251), 0.9e-3);
  for (const double t : {0.0245, 0.0257}) EXPECT_LT(excess(t), 0.0);
  const Certificate broken = over(1e-3);
  expect_only(broken, Kind::net_stretch);
  EXPECT_NEAR(broken.violations.front().time, 0.0251, 1e-3);
  EXPECT_EQ(broken.violations.front().robot, 1);
  EXPECT_EQ(broken.violations.front().other, 3);
  expect_holds(over(-1e-3));
}

TEST(PlantedNet, PairsThatAreNoNeighboursCountToo) {
  // A rhombus: its sides are short, one diagonal is longer than the cloth.
  const std::vector<Vec2> rhombus{{0.0, -1.35}, {0.6, 0.0}, {0.0, 1.35}, {-0.6, 0.0}};
  NetTeam team = parked_team(rhombus, regular(4, 1.4));
  team.net().stretch = 0.95;
  const Certificate broken = team.judge();
  expect_only(broken, Kind::net_stretch);
  ASSERT_EQ(broken.violations.size(), 1u);
  EXPECT_EQ(broken.violations.front().other, 2);
}

TEST(PlantedNet, Twists) {
  // One car drives through the opposite side of the net and back: for a while the ring is a bow tie.
  traj::TeamTrajectory plan{{there_and_back({-1.0, -1.0, 0.0}, 3.0, 1.0), parked({1.0, -1.0, 0.0}),
                             parked({1.0, 1.0, 0.0}), parked({-1.0, 1.0, 0.0})}};
  expect_only(net_team(plan, square(1.5), {0.0, 0.0}).judge(), Kind::net_topology);
  // Clockwise from the beginning.
  expect_only(parked_team({{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}, square(1.5)).judge(), Kind::net_topology);
  // A star has left turns only, but winds twice.
  const std::vector<Vec2> ring = regular(5, 1.2);
  const Certificate star =
      parked_team({ring[0], ring[2], ring[4], ring[1], ring[3]}, regular(5, 1.4)).judge();
  EXPECT_TRUE(breaks(star, Kind::net_topology)) << summary(star);
  expect_holds(parked_team(ring, regular(5, 1.4)).judge());
  // Two cars' attachments at one place, a corner just not dented, and one dented.
  expect_only(parked_team({{-1, -1}, {1, -1}, {1, -1}, {-1, 1}}, square(1.5)).judge(), Kind::net_topology);
  expect_only(parked_team({{-1, -1}, {1, -1}, {0.01, 0.01}, {-1, 1}}, square(1.5)).judge(),
              Kind::net_topology);
  expect_holds(parked_team({{-1, -1}, {1, -1}, {0.2, 0.2}, {-1, 1}}, square(1.5)).judge());
}

TEST(PlantedNet, CornersCutWhileTheRingTurns) {
  // Straight ways at an even speed carry every corner to the place of the next: half way the ring is smaller
  // by a half, and nothing accelerates.
  const auto turning = [](double height) {
    const std::vector<Vec2> corners = regular(3, height * 2.0 / 3.0);
    traj::TeamTrajectory plan;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 way = corners[(k + 1) % 3] - corners[k];
      const geom::Pose2 start{corners[k].x, corners[k].y, std::atan2(way.y, way.x)};
      plan.robots.push_back(straight(start, geom::norm(way), 1.0));
      plan.robots.back().segments.front().piece_duration = 1.0;
      plan.robots.back().segments.front().progress = {{0.0, 1.0, 0.0, 0.0, 0.0, 0.0}};
    }
    return net_team(plan, regular(3, 1.0), {0.0, 0.0}).judge();
  };
  for (const double off : {-1e-3, 1e-3}) {
    const Certificate certificate = turning(2.0 * (net::kConvexMargin + off));
    EXPECT_EQ(breaks(certificate, Kind::net_topology), off < 0.0) << summary(certificate);
  }
}

TEST(PlantedNet, TooNarrowATriangle) {
  for (const double height : {0.0485, 0.0515}) {
    const Certificate certificate = parked_team({{-1, 0}, {1, 0}, {0, height}}, regular(3, 1.4)).judge();
    EXPECT_EQ(certificate.holds, height > net::kConvexMargin) << summary(certificate);
    EXPECT_NEAR(certificate.net.convexity.clearance, height - net::kConvexMargin, 1e-9);
  }
}

TEST(PlantedNet, APoleForAnInstant) {
  // The corner of a fast net passes a needle: 1 mm of overlap, 2 mm of way, at 40 m/s.
  NetTeam team = driving_team(regular(4, 1.2), regular(4, 1.4), 20.0, 1.0);
  const auto pole = [&](double inside) {
    team.scenario.obstacles = {
        {.name = "pole", .shape = world::Circle{{10.0, 1.2 - inside + 1e-4}, 1e-4}, .motion = {}}};
    return team.judge();
  };
  const Certificate broken = pole(1e-3);
  expect_only(broken, Kind::net_obstacle);
  EXPECT_NEAR(broken.violations.front().value, -1e-3, 1e-3);
  EXPECT_NEAR(broken.violations.front().time, 0.5, 0.02);
  expect_holds(pole(-1e-3));
  EXPECT_NEAR(pole(-0.1).net.obstacles.clearance, 0.1, 1e-2);
}

TEST(PlantedNet, ABulgeBetweenLooks) {
  // A square drives a flat arc at an even speed, its side's highest instant at 0.3 of the way, in one cell. A
  // pole above it is touched then only; another one is always nearer but clear, so that no look is taken only
  // because it is the closest.
  traj::TeamTrajectory plan;
  constexpr double kRise = 0.03;
  for (const Vec2 corner : square(1.0)) {
    plan.robots.push_back(straight({corner.x, corner.y, 0.0}, 1.0, 1.0));
    traj::Segment& segment = plan.robots.back().segments.front();
    const double bend = kRise / 0.49;
    segment.curve = {{{{corner.x, 1.0, 0, 0, 0, 0}, {corner.y, 0.6 * bend, -bend, 0, 0, 0}}}};
    segment.progress = {{0.0, 1.0, 0, 0, 0, 0}}, segment.piece_duration = 1.0;
  }
  NetTeam team = net_team(plan, square(1.2), {0.0, 0.0});
  team.scenario.models[0].footprint = vehicle::rectangle_footprint(1.5, 0.4, 0.25);
  const double top = 1.0 + 0.09 * kRise / 0.49;
  for (const double touch : {-5e-4, 5e-4}) {
    team.scenario.obstacles = {
        {.name = "",
         .shape = std::vector<Vec2>{{0.4, top + 2e-4}, {0.5, top + 2e-4}, {0.45, 2.0}},
         .motion = {}},
        {.name = "",
         .shape = std::vector<Vec2>{{0.0, top - touch}, {0.1, top - touch}, {0.05, 2.0}},
         .motion = {}}};
    EXPECT_EQ(breaks(team.judge(), Kind::net_obstacle), touch > 0.0) << summary(team.judge());
  }
}

TEST(PlantedNet, ATurningBarBetweenLooks) {
  // Its tip sweeps over the side of a net that stands still, in one cell.
  NetTeam team = parked_team(square(1.0), square(1.2));
  team.scenario.models[0].footprint = vehicle::rectangle_footprint(10.0, 0.4, 1.0);
  const std::vector<Vec2> bar{{0.0, -0.01}, {1.0, 0.0}, {0.0, 0.01}};
  for (const double touch : {-5e-4, 5e-4}) {
    const double y = 2.0 - touch;
    team.scenario.obstacles = {
        {.name = "", .shape = std::vector<Vec2>{{0.4, 1.0002}, {0.5, 1.0002}, {0.45, 2.0}}, .motion = {}},
        {.name = "", .shape = bar, .motion = {{0.0, {0.0, y, -2.2}}, {1.0, {0.0, y, -1.1}}}}};
    EXPECT_EQ(breaks(team.judge(), Kind::net_obstacle), touch > 0.0) << summary(team.judge());
  }
}

TEST(PlantedNet, PolesInside) {
  // Between the corners all the way, never near an edge: it moves with the team.
  NetTeam team = driving_team(square(1.0), square(1.2), 4.0, 2.0);
  const auto with = [&](world::Obstacle obstacle) {
    team.scenario.obstacles = {std::move(obstacle)};
    return team.judge();
  };
  const world::Circle pole{{0.0, 0.0}, 0.05};
  expect_only(with({.name = "", .shape = pole, .motion = {{0.0, {0, 0, 0}}, {2.0, {4, 0, 0}}}}),
              Kind::net_obstacle);
  // Stands still: the net drives over it. Comes in long after everybody has arrived. Just stays out.
  expect_only(with({.name = "", .shape = world::Circle{{3.0, 0.0}, 0.05}, .motion = {}}), Kind::net_obstacle);
  expect_only(with({.name = "", .shape = pole, .motion = {{70.0, {4, 50, 0}}, {70.1, {4, -50, 0}}}}),
              Kind::net_obstacle);
  expect_holds(with({.name = "", .shape = pole, .motion = {{70.0, {4, 50, 0}}, {70.1, {4, 1.06, 0}}}}));
  // A wall that contains the whole net.
  expect_only(with({.name = "", .shape = square(30.0), .motion = {}}), Kind::net_obstacle);
}

TEST(PlantedNet, MapCellsAreTall) {
  NetTeam team = driving_team(square(1.0), square(1.2), 4.0, 2.0);
  geom::OccupancyGrid grid;
  grid.width = grid.height = 40, grid.resolution = 0.25;
  grid.origin = {-3.0, -5.0, 0.0};
  grid.occupied.assign(1600, 0);
  team.scenario.map = grid;
  expect_holds(team.judge());
  team.scenario.map->occupied[20 * 40 + 24] = 1;
  expect_only(team.judge(), Kind::net_obstacle);
}

TEST(PlantedNet, LowObstaclesUnderneath) {
  // No point of the cloth hangs deeper than a load would.
  NetTeam team = driving_team(regular(4, 1.26), regular(4, 1.4), 4.0, 2.0);
  team.net().clearance = 0.05;
  const std::vector<Vec2> at = Grid(team, 0.0, 1e-4).at(0.0);
  const double loaded = 1.0 - net::loaded_depth(team.net(), at);
  const auto over = [&](double height) {
    team.scenario.obstacles = {
        {.name = "step", .shape = world::Circle{{2.0, 0.0}, 0.1}, .height = height, .motion = {}}};
    return team.judge();
  };
  const double most = loaded - 0.05;
  expect_holds(over(most - 1e-3));
  expect_only(over(most + 1e-3), Kind::net_obstacle);
  // It moves in under the net that has come to rest.
  for (const double height : {loaded - 0.05 - 1e-3, loaded - 0.05 + 1e-3}) {
    over(height);
    team.scenario.obstacles[0].motion = {{9.0, {2.0, 9.0, 0.0}}, {10.0, {2.0, 0.5, 0.0}}};
    EXPECT_EQ(team.judge().holds, height < loaded - 0.05) << summary(team.judge());
  }
}

TEST(PlantedNet, Drags) {
  // The team closes in by driving towards each other.
  const auto closing = [](double length) {
    traj::TeamTrajectory plan;
    for (const Vec2 corner : regular(4, 1.3)) {
      plan.robots.push_back(straight({corner.x, corner.y, std::atan2(-corner.y, -corner.x)}, length, 1.0));
    }
    return net_team(plan, regular(4, 1.4), {0.0, 0.0});
  };
  // A regular net of half diagonal 1.4 hangs √(1.4² − r²) deep.
  const double limit = std::sqrt(1.4 * 1.4 - 0.9 * 0.9);
  for (const double off : {-1e-3, 1e-3}) {
    NetTeam team = closing(1.3 - limit + off);
    team.net().clearance = 0.1;
    EXPECT_EQ(team.judge().holds, off < 0.0) << summary(team.judge());
    if (off > 0.0) expect_only(team.judge(), Kind::net_drag);
    // Open again at the end: only an instant.
    for (std::size_t k = 0; k < 4; ++k) {
      const geom::Pose2 start = team.scenario.robots[k].start;
      team.plan.robots[k] = there_and_back(start, 1.3 - limit + off, 0.05);
      team.scenario.robots[k].goal = start;
    }
    EXPECT_EQ(team.judge().holds, off < 0.0) << summary(team.judge());
  }
}

TEST(PlantedNet, DragsWithoutALoad) {
  // Narrow until t = 1, when it opens. What falls in has nothing to do with it.
  traj::TeamTrajectory plan;
  for (const Vec2 corner : regular(4, 0.9)) {
    plan.robots.push_back(
        after(1.0, straight({corner.x, corner.y, std::atan2(corner.y, corner.x)}, 0.4, 1.0)));
  }
  NetTeam team = net_team(plan, regular(4, 1.4), {0.0, 0.0});
  team.net().clearance = 0.1;
  EXPECT_TRUE(breaks(team.judge(), Kind::net_drag)) << summary(team.judge());
  // Neighbours side by side: the cloth between them hangs in a narrow loop.
  for (const double side : {0.02, 0.1, 0.3, 0.6, 0.9}) {
    team = parked_team(regular(4, side * std::sqrt(0.5)), regular(4, 1.4));
    team.net().clearance = 0.05;
    EXPECT_TRUE(breaks(team.judge(), Kind::net_drag)) << side;
  }
  // Long after everybody has arrived in too narrow a formation.
  team = parked_team(regular(4, 0.9), regular(4, 1.4));
  team.net().clearance = 0.1;
  EXPECT_TRUE(breaks(team.judge(), Kind::net_drag)) << summary(team.judge());
  // Spread wide it hangs high enough.
  team = parked_team(regular(4, 1.35), regular(4, 1.4));
  team.net().clearance = 0.05;
  EXPECT_FALSE(breaks(team.judge(), Kind::net_drag)) << summary(team.judge());
}

TEST(PlantedNet, IsNotDelivered) {
  NetTeam team = driving_team(square(1.0), square(1.2), 4.0, 2.0);
  for (auto& robot : team.scenario.robots) robot.goal.reset();
  const auto judged = [&](net::Delivery delivery) {
    team.scenario.delivery = delivery;
    return team.judge();
  };
  expect_holds(judged({.center = {4.499, 0.0}, .radius = 0.5, .heading = {}}));
  expect_only(judged({.center = {4.501, 0.0}, .radius = 0.5, .heading = {}}), Kind::delivery);
  expect_holds(judged({.center = {4.0, 0.0}, .radius = 0.5, .heading = 0.099}));
  const Certificate turned = judged({.center = {4.0, 0.0}, .radius = 0.5, .heading = -0.101});
  expect_only(turned, Kind::delivery);
  EXPECT_EQ(turned.violations.size(), 4u);
  // Without a delivery anywhere is right; goals that are given still count.
  team.scenario.delivery.reset();
  expect_holds(team.judge());
  team.scenario.robots[1].goal = geom::Pose2{0.0, 0.0, 0.0};
  expect_only(team.judge(), Kind::goal);
}

TEST(PlantedNet, InsideASolidAreaOfTheMap) {
  NetTeam team = parked_team(square(1.0), square(1.2));
  geom::OccupancyGrid grid{60, 60, 0.1, {-3.0, -3.0, 0.0}, {}};
  grid.occupied.assign(3600, 0);
  team.scenario.map = grid;
  EXPECT_FALSE(breaks(team.judge(), Kind::net_obstacle)) << summary(team.judge());
  for (int row = 12; row < 48; ++row)
    for (int column = 12; column < 48; ++column)
      team.scenario.map->occupied[static_cast<std::size_t>(60 * row + column)] = 1;
  EXPECT_TRUE(breaks(team.judge(), Kind::net_obstacle)) << summary(team.judge());
}

TEST(PlantedNet, QuestionsThatMakeNoSense) {
  NetTeam team = parked_team(square(1.0), square(1.2));
  team.net().rest.pop_back();
  EXPECT_THROW(team.judge(), InputError);
  team.net().rest = regular(5, 1.4);
  EXPECT_THROW(team.judge(), InputError);
  team.scenario.net.reset();
  team.scenario.payload = net::Payload{};
  expect_only(team.judge(), Kind::malformed);
}

TEST(PlantedNet, OutOfTimeIsNotAProof) {
  const NetTeam team = driving_team(square(1.0), square(1.2), 4.0, 2.0);
  const Certificate late = team.judge({.threads = 1, .deadline = Deadline(0.0)});
  EXPECT_TRUE(!late.holds && breaks(late, Kind::undecided)) << summary(late);
}

}  // namespace
}  // namespace seine::certify::test
