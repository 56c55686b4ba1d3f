#include "seine/world/static_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::world {
namespace {

using geom::Box;
using geom::Vec2;

constexpr std::uint64_t kSeed = 31;

// A few polygons and circles, some beyond the bounds, and a turned bitmap now and then.
Scenario random_scenario(Rng& rng) {
  Scenario scenario;
  scenario.bounds = {{-2.0, -1.0}, {rng.uniform(6.0, 30.0), rng.uniform(6.0, 20.0)}};
  for (int i = rng.below(40); i > 0; --i) {
    const Vec2 c{rng.uniform(-6.0, 30.0), rng.uniform(-6.0, 24.0)};
    Obstacle obstacle;
    if (rng.below(3) == 0) {
      obstacle.shape = Circle{c, rng.uniform(0.05, 2.0)};
    } else {
      std::vector<Vec2> star;
      const double turn = rng.uniform(0.0, 6.0);
      for (int k = 0; k < 7; ++k) star.push_back(c + rng.uniform(0.2, 2.0) * geom::unit(turn + 0.9 * k));
      obstacle.shape = star;
    }
    scenario.obstacles.push_back(obstacle);
  }
  if (rng.below(2) == 0) {
    geom::OccupancyGrid grid{.width = 60,
                             .height = 50,
                             .resolution = 0.2,
                             .origin = {1.0, -1.0, rng.uniform(-0.5, 0.5)},
                             .occupied = std::vector<std::uint8_t>(3000, 0)};
    for (int i = 0; i < 300; ++i) grid.occupied[static_cast<std::size_t>(rng.below(3000))] = 1;
    scenario.map = grid;
  }
  return scenario;
}

std::vector<Vec2> random_footprint(Rng& rng, const Box& bounds) {
  std::vector<Vec2> footprint =
      vehicle::rectangle_footprint(rng.uniform(0.3, 3.0), rng.uniform(0.2, 2.0), 0.2);
  const geom::Pose2 pose{rng.uniform(bounds.low.x - 0.5, bounds.high.x + 0.5),
                         rng.uniform(bounds.low.y - 0.5, bounds.high.y + 0.5), rng.uniform(-3.0, 3.0)};
  geom::place(std::vector<Vec2>(footprint), pose, footprint);
  return footprint;
}

double to_walls(const std::vector<Vec2>& polygon, const Box& bounds) {
  const Box box = geom::bounding_box(polygon);
  return std::min(std::min(box.low.x - bounds.low.x, box.low.y - bounds.low.y),
                  std::min(bounds.high.x - box.high.x, bounds.high.y - box.high.y));
}

void expect_queries_match(const StaticMap& map, const std::vector<Vec2>& polygon, double cap) {
  double truth = std::numeric_limits<double>::infinity();
  for (const StaticMap::Piece& piece : map.pieces()) {
    truth = std::min(truth, geom::separation({polygon, 0.0}, piece.shape).distance);
  }
  const double walls = to_walls(polygon, map.bounds());
  const StaticMap::Nearest nearest = map.nearest(polygon, cap);
  EXPECT_NEAR(nearest.distance, std::min({truth, walls, cap}), 1e-9);
  EXPECT_EQ(nearest.bounds, walls < truth && walls <= cap);
  if (nearest.piece >= 0 || nearest.bounds) {
    EXPECT_NEAR(nearest.separation.distance, nearest.distance, 1e-9);
    const Vec2 step = nearest.separation.point_b - nearest.separation.point_a;
    EXPECT_NEAR(geom::dot(step, nearest.separation.normal), nearest.distance, 1e-9);
  }
  for (const double clearance : {0.0, 0.05, 0.4}) {
    if (std::abs(std::min(truth, walls) - clearance) < 1e-8) continue;
    EXPECT_EQ(map.clear(polygon, clearance), std::min(truth, walls) > clearance);
  }
}

TEST(StaticMap, AnswersLikeALookAtEveryPiece) {
  Rng rng(kSeed);
  for (int scene = 0; scene < 60; ++scene) {
    const Scenario scenario = random_scenario(rng);
    const StaticMap map(scenario);
    for (int i = 0; i < 200; ++i) {
      const double cap = i % 5 == 0 ? std::numeric_limits<double>::infinity() : rng.uniform(0.0, 3.0);
      expect_queries_match(map, random_footprint(rng, map.bounds()), cap);
      if (HasFailure()) FAIL() << "seed " << kSeed << " scene " << scene << " query " << i;
    }
  }
}

TEST(StaticMap, VisitsEachOverlappingPieceOnceInOrderAlsoNested) {
  Rng rng(kSeed);
  for (int scene = 0; scene < 50; ++scene) {
    const StaticMap map(random_scenario(rng));
    const auto list = [&map](const Box& box) {
      std::vector<std::ptrdiff_t> found;
      map.for_each_near(
          box, [&](const StaticMap::Piece& piece) { found.push_back(&piece - map.pieces().data()); });
      return found;
    };
    const auto expected = [&map](const Box& box) {
      std::vector<std::ptrdiff_t> found;
      for (const auto& piece : map.pieces()) {
        if (piece.box.overlaps(box)) found.push_back(&piece - map.pieces().data());
      }
      return found;
    };
    const Vec2 low{rng.uniform(-8.0, 30.0), rng.uniform(-8.0, 20.0)};
    const Box outer{low, low + Vec2{rng.uniform(0.0, 9.0), rng.uniform(0.0, 9.0)}};
    EXPECT_EQ(list(outer), expected(outer)) << "seed " << kSeed << " scene " << scene;
    std::vector<std::ptrdiff_t> order;
    map.for_each_near(outer, [&](const StaticMap::Piece& piece) {
      order.push_back(&piece - map.pieces().data());
      EXPECT_EQ(list(piece.box), expected(piece.box));
    });
    EXPECT_EQ(order, expected(outer));
  }
}

TEST(StaticMap, ThreadsDoNotDisturbEachOther) {
  Rng rng(kSeed);
  const StaticMap map(random_scenario(rng));
  const auto count = [&map] {
    std::size_t seen = 0;
    for (int i = 0; i < 2000; ++i) map.for_each_near(map.bounds(), [&](const StaticMap::Piece&) { ++seen; });
    return seen;
  };
  const std::size_t expected = count();
  std::vector<std::size_t> results(4);
  std::vector<std::thread> threads;
  for (std::size_t& result : results) threads.emplace_back([&result, &count] { result = count(); });
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t result : results) EXPECT_EQ(result, expected);
}

TEST(StaticMap, NamesPiecesAndRefusesKnots) {
  Scenario scenario;
  scenario.bounds = {{0.0, 0.0}, {10.0, 10.0}};
  scenario.obstacles.resize(3);
  scenario.obstacles[0].shape = Circle{{2.0, 2.0}, 1.0};
  scenario.obstacles[1].shape = Circle{{5.0, 5.0}, 1.0};
  scenario.obstacles[1].motion = {{0.0, {5.0, 5.0, 0.0}}, {9.0, {6.0, 5.0, 0.0}}};
  scenario.obstacles[2].shape = std::vector<Vec2>{{7, 7}, {9, 7}, {9, 8}};
  scenario.obstacles[2].name = "shelf";
  const StaticMap map(scenario);
  ASSERT_EQ(map.pieces().size(), 2U);  // the moving one is not static
  EXPECT_EQ(map.describe(0), "obstacle 1");
  EXPECT_EQ(map.describe(1), "shelf");
  EXPECT_EQ(map.describe(-1), "the bounds");
  scenario.obstacles[2].shape = std::vector<Vec2>{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  EXPECT_THROW(StaticMap{scenario}, InputError);
}

TEST(StaticMap, TouchingCountsAsClearWithoutAMargin) {
  Scenario scenario;
  scenario.bounds = {{0.0, 0.0}, {10.0, 10.0}};
  scenario.obstacles.push_back(
      {.name = "", .shape = std::vector<Vec2>{{3, 3}, {4, 3}, {4, 4}, {3, 4}}, .motion = {}});
  const StaticMap map(scenario);
  EXPECT_TRUE(map.clear(std::vector<Vec2>{{0, 3}, {3, 3}, {3, 4}, {0, 4}}, 0.0));
  EXPECT_FALSE(map.clear(std::vector<Vec2>{{0, 3}, {3.001, 3}, {3.001, 4}, {0, 4}}, 0.0));
  EXPECT_FALSE(map.clear(std::vector<Vec2>{{0, 3}, {3, 3}, {3, 4}, {0, 4}}, 0.001));
}

}  // namespace
}  // namespace seine::world
