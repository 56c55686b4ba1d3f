#include "seine/corridor/corridor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/geom/convex.hpp"

namespace seine::corridor {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr std::uint64_t kSeed = 404;
constexpr double kSlack = 1e-9;  // m

vehicle::Model car(double length, double width) {
  return {
      .name = "car", .footprint = vehicle::rectangle_footprint(length, width, 0.2 * length), .limits = {}};
}

// Polygons (convex or not) and discs of 0.4 to 1 m radius in a 20 × 20 m arena.
world::Scenario random_scene(Rng& rng, int count) {
  world::Scenario scenario;
  scenario.bounds = {{0.0, 0.0}, {20.0, 20.0}};
  for (int i = 0; i < count; ++i) {
    const Vec2 center{rng.uniform(0.0, 20.0), rng.uniform(0.0, 20.0)};
    const double radius = rng.uniform(0.4, 1.0);
    world::Obstacle obstacle;
    obstacle.shape = world::Circle{center, radius};
    if (rng.below(3) > 0) {
      std::vector<Vec2> polygon;
      for (int k = 0; k < 6; ++k)
        polygon.push_back(center + radius * rng.uniform(0.4, 1.0) * geom::unit(1.04 * k));
      obstacle.shape = polygon;
    }
    scenario.obstacles.push_back(obstacle);
  }
  return scenario;
}

// A binary PGM as a grid: everything darker than white is an obstacle.
geom::OccupancyGrid read_pgm(const std::string& path, double resolution) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  geom::OccupancyGrid grid;
  int depth = 0;
  const auto next = [&file](auto& value) {
    while ((file >> std::ws).peek() == '#') file.ignore(4096, '\n');
    file >> value;
  };
  next(magic), next(grid.width), next(grid.height), next(depth);
  file.get();
  const std::size_t width = static_cast<std::size_t>(grid.width),
                    height = static_cast<std::size_t>(grid.height);
  grid.resolution = resolution;
  grid.occupied.resize(width * height);
  for (std::size_t row = height; row-- > 0;) {
    for (std::size_t column = 0; column < width; ++column)
      grid.occupied[row * width + column] = file.get() < 250;
  }
  return grid;
}

bool in_region(const Corridor& corridor, std::size_t sample, Vec2 p) {
  for (int k = corridor.begin[sample]; k < corridor.begin[sample + 1]; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    if (corridor.nx[i] * p.x + corridor.ny[i] * p.y > corridor.b[i]) return false;
  }
  return true;
}

struct Seen {
  int in_region = 0;
  int violated = 0;
};

// All that the header promises of one sample.
void expect_promises(const Corridor& corridor, std::size_t sample, const Pose2& pose,
                     const vehicle::Model& model, const world::StaticMap& map, const Options& options,
                     Rng& rng, Seen& seen) {
  const geom::Convex footprint = geom::placed({model.footprint, 0.0}, pose);
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<const geom::Convex*> near;
  map.for_each_near(footprint.box().inflated(options.reach), [&](const world::StaticMap::Piece& piece) {
    const double distance = geom::separation(footprint, piece.shape).distance;
    nearest = std::min(nearest, distance);
    if (distance <= options.reach) near.push_back(&piece.shape);
  });
  const geom::Box box = footprint.box();
  const geom::Box& bounds = map.bounds();
  nearest = std::min({nearest, box.low.x - bounds.low.x, box.low.y - bounds.low.y, bounds.high.x - box.high.x,
                      bounds.high.y - box.high.y});

  ASSERT_EQ(corridor.left_out[sample], 0);
  // The footprint is inside when the guess keeps the clearance, otherwise by how much it is not.
  ASSERT_NEAR(corridor.depth[sample], std::max(options.clearance - nearest, 0.0), kSlack);
  seen.violated += corridor.depth[sample] > 0.0;
  for (const Vec2 v : footprint.core)
    ASSERT_TRUE(corridor.depth[sample] > 0.0 || in_region(corridor, sample, v));

  const geom::Box around = box.inflated(options.reach);
  const auto inside_wall = [&options](double room_of_car, double room_of_point) {
    return room_of_car > options.reach || room_of_point >= options.clearance - kSlack;
  };
  for (int i = 0; i < 40; ++i) {
    const Vec2 p{rng.uniform(around.low.x, around.high.x), rng.uniform(around.low.y, around.high.y)};
    if (!in_region(corridor, sample, p)) continue;
    ++seen.in_region;
    for (const geom::Convex* piece : near) {
      ASSERT_GE(geom::separation({{p}, 0.0}, *piece).distance, options.clearance - kSlack);
    }
    ASSERT_TRUE(inside_wall(box.low.x - bounds.low.x, p.x - bounds.low.x));
    ASSERT_TRUE(inside_wall(box.low.y - bounds.low.y, p.y - bounds.low.y));
    ASSERT_TRUE(inside_wall(bounds.high.x - box.high.x, bounds.high.x - p.x));
    ASSERT_TRUE(inside_wall(bounds.high.y - box.high.y, bounds.high.y - p.y));
  }
}

Seen expect_promises(const world::StaticMap& map, const vehicle::Model& model,
                     const std::vector<Pose2>& poses, const Options& options, Rng& rng) {
  const Corridor corridor = build(poses, model, map, options);
  EXPECT_EQ(corridor.samples(), poses.size());
  Seen seen;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    expect_promises(corridor, i, poses[i], model, map, options, rng, seen);
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "seed " << kSeed << " sample " << i;
      break;
    }
  }
  return seen;
}

TEST(Corridor, KeepsItsPromisesAmongPolygonsAndDiscs) {
  Rng rng(kSeed);
  for (int scene = 0; scene < 40; ++scene) {
    const world::StaticMap map(random_scene(rng, 10 + rng.below(60)));
    const vehicle::Model model = car(rng.uniform(0.4, 2.0), rng.uniform(0.3, 1.0));
    const Options options{
        .reach = rng.uniform(0.2, 1.5), .clearance = rng.uniform(0.0, 0.1), .max_planes = 64};
    std::vector<Pose2> poses;
    for (int i = 0; i < 200; ++i) {
      poses.push_back({rng.uniform(-0.3, 20.3), rng.uniform(-0.3, 20.3), rng.uniform(-3.14, 3.14)});
    }
    const Seen seen = expect_promises(map, model, poses, options, rng);
    EXPECT_GT(seen.in_region, 100);
    EXPECT_GT(seen.violated, 3);
    if (HasFailure()) FAIL() << "scene " << scene;
  }
}

TEST(Corridor, KeepsItsPromisesInARecordedMap) {
  Rng rng(kSeed);
  world::Scenario scenario;
  scenario.map = read_pgm(std::string(SEINE_DATA_DIR) + "/maps/ros/intel.pgm", 0.05);
  scenario.bounds = scenario.map->box();
  const world::StaticMap map(scenario);
  ASSERT_GT(map.pieces().size(), 100U);
  const vehicle::Model model = car(0.6, 0.4);
  const Options options{.reach = 0.6, .clearance = 0.03, .max_planes = 64};
  std::vector<Pose2> poses;
  while (poses.size() < 500) {  // most of them free
    const Pose2 pose{rng.uniform(0.0, scenario.bounds.high.x), rng.uniform(0.0, scenario.bounds.high.y),
                     rng.uniform(-3.0, 3.0)};
    const geom::Convex footprint = geom::placed({model.footprint, 0.0}, pose);
    if (map.nearest(footprint.core, 1.0).distance < 0.8 &&
        (map.clear(footprint.core, 0.03) || rng.below(50) == 0)) {
      poses.push_back(pose);
    }
  }
  const Seen seen = expect_promises(map, model, poses, options, rng);
  EXPECT_GT(seen.in_region, 1000);
}

TEST(Corridor, AFaceGivesItsPlaneAndHidesWhatIsBehindIt) {
  world::Scenario scenario;
  scenario.bounds = {{-10.0, -10.0}, {10.0, 10.0}};
  const auto block = [](double x, double y) {
    return std::vector<Vec2>{{x, y}, {x + 1.0, y}, {x + 1.0, y + 0.1}, {x, y + 0.1}};
  };
  for (const double y : {0.5, 0.7}) {
    for (const double x : {-2.0, -1.0, 0.0, 1.0})
      scenario.obstacles.push_back({.name = "", .shape = block(x, y), .motion = {}});
  }
  const world::StaticMap map(scenario);
  const std::vector<Pose2> poses{{0.0, 0.0, 0.1}, {0.0, -5.0, 0.0}};
  const Corridor corridor = build(poses, car(0.6, 0.4), map, {.reach = 0.6, .clearance = 0.05});
  ASSERT_EQ(corridor.begin, (std::vector<int>{0, 1, 1}));
  EXPECT_NEAR(corridor.nx[0], 0.0, 1e-12);
  EXPECT_NEAR(corridor.ny[0], 1.0, 1e-12);
  EXPECT_NEAR(corridor.b[0], 0.45, 1e-12);
}

TEST(Corridor, SaysWhatMaxPlanesLeavesOut) {
  world::Scenario scenario;
  scenario.bounds = {{-10.0, -10.0}, {10.0, 10.0}};
  for (const double angle : {0.0, 1.6, 3.1, 4.7}) {
    scenario.obstacles.push_back(
        {.name = "", .shape = world::Circle{0.8 * geom::unit(angle), 0.1}, .motion = {}});
  }
  const world::StaticMap map(scenario);
  const std::vector<Pose2> poses{{0.0, 0.0, 0.0}};
  const Corridor corridor =
      build(poses, car(0.6, 0.4), map, {.reach = 1.0, .clearance = 0.05, .max_planes = 3});
  EXPECT_EQ(corridor.b.size(), 3U);
  EXPECT_EQ(corridor.left_out[0], 1);
}

}  // namespace
}  // namespace seine::corridor
