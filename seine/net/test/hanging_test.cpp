// The cloth reaches (p, z) with its point v when |(p, z) − (a_k, h)| ≤ |v − r_k| for every corner k. The
// tests look for the lowest place by search, without the active sets of the implementation.
#include "seine/net/hanging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "seine/base/effort.hpp"
#include "seine/geom/box.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/net/shape.hpp"
#include "seine/net/test/nets.hpp"

namespace seine::net {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 2024;

struct Cloth {
  std::vector<Vec2> rest, hold;

  double squared_depth(Vec2 p, Vec2 v) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rest.size(); ++k)
      least = std::min(least, geom::squared_norm(v - rest[k]) - geom::squared_norm(p - hold[k]));
    return least;
  }

  // The deepest over p: min_k w_k − |p − a_k|² is concave with circular level sets, so its top is an a_k,
  // lies on the line between two of them, or is the point of equal value of three.
  double squared_depth(Vec2 v) const {
    double best = -std::numeric_limits<double>::infinity();
    const auto offer = [&](Vec2 p) { best = std::max(best, squared_depth(p, v)); };
    const auto weight = [&](std::size_t k) {
      return geom::squared_norm(v - rest[k]) - geom::squared_norm(hold[k]);
    };
    for (std::size_t i = 0; i < rest.size(); ++i) {
      offer(hold[i]);
      for (std::size_t j = 0; j < i; ++j) {
        const Vec2 e = hold[j] - hold[i];
        const double c = 0.5 * (weight(i) - weight(j));
        offer(hold[i] + ((c - geom::dot(e, hold[i])) / geom::squared_norm(e)) * e);
        for (std::size_t k = 0; k < j; ++k) {
          const Vec2 f = hold[k] - hold[i];
          const double b = 0.5 * (weight(i) - weight(k));
          const double det = geom::cross(e, f);
          if (det != 0.0) offer({(c * f.y - b * e.y) / det, (b * e.x - c * f.x) / det});
        }
      }
    }
    return best;
  }
};

// Best of a grid over the net, then of ever smaller random steps from the five best places.
double deepest_by_search(const Cloth& cloth, Rng& rng) {
  const geom::Box box = geom::bounding_box(cloth.rest);
  std::vector<std::pair<double, Vec2>> tops;
  constexpr int kGrid = 24;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const Vec2 v{box.low.x + box.size().x * i / kGrid, box.low.y + box.size().y * j / kGrid};
      if (geom::contains(cloth.rest, v)) tops.emplace_back(cloth.squared_depth(v), v);
    }
  std::sort(tops.begin(), tops.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  tops.resize(std::min<std::size_t>(tops.size(), 5));
  double best = 0.0;
  for (auto [depth, v] : tops) {
    double step = 0.1;
    for (int i = 0; i < 600; ++i, step *= 0.98) {
      const Vec2 next = v + step * Vec2{rng.normal(), rng.normal()};
      if (!geom::contains(cloth.rest, next)) continue;
      const double deeper = cloth.squared_depth(next);
      if (deeper > depth) depth = deeper, v = next;
    }
    best = std::max(best, depth);
  }
  return std::sqrt(best);
}

TEST(LoadedDepth, IsTheDeepestThatASearchFinds) {
  Rng rng(kSeed);
  for (const std::size_t corners : {3u, 4u, 5u, 6u, 8u}) {
    for (int round = 0; round < effort(25, 8); ++round) {
      const Net net = net_of(random_convex(rng, corners));
      const Cloth cloth{net.rest, random_hold(rng, net.rest)};
      const double found = deepest_by_search(cloth, rng);
      const double depth = loaded_depth(net, cloth.hold);
      EXPECT_LE(found, depth + 1e-7) << corners << " corners, round " << round << ", seed " << kSeed;
      EXPECT_GE(found, depth - 1e-3) << corners << " corners, round " << round << ", seed " << kSeed;
    }
  }
}

TEST(LoadedDepth, OfARegularNetIsTheClosedForm) {
  for (const std::size_t corners : {3u, 4u, 5u, 6u, 7u, 8u, 12u}) {
    for (const double scale : {0.3, 0.7, 0.86, 0.9, 0.95}) {
      const Net net = net_of(regular_polygon(corners, 1.4));
      const std::vector<Vec2> hold = regular_polygon(corners, 1.4 * scale, 0.3);
      const double expected = 1.4 * std::sqrt(1.0 - scale * scale);
      EXPECT_NEAR(loaded_depth(net, hold), expected, 1e-9) << corners << " corners";
      const std::vector<Hanging> all = equilibria(net.rest, hold, 1.0);
      ASSERT_EQ(all.size(), 1u);
      EXPECT_NEAR(all[0].position.z, 1.0 - expected, 1e-9);
      EXPECT_EQ(all[0].taut.size(), corners);
      EXPECT_FALSE(all[0].at_edge);
    }
  }
}

TEST(LoadedDepth, DoesNotDependOnTheFrameAndScalesWithTheUnit) {
  Rng rng(kSeed + 1);
  for (int round = 0; round < 100; ++round) {
    const Net net = net_of(random_convex(rng, 3 + static_cast<std::size_t>(rng.below(6))));
    const std::vector<Vec2> hold = random_hold(rng, net.rest);
    const Vec2 turn = geom::unit(rng.uniform(-3.0, 3.0));
    Net large = net;
    std::vector<Vec2> moved;
    for (Vec2& r : large.rest) r = 1000.0 * r + Vec2{70.0, -30.0};
    for (const Vec2 a : hold)
      moved.push_back(1000.0 * Vec2{turn.x * a.x - turn.y * a.y + 5.0, turn.y * a.x + turn.x * a.y});
    EXPECT_NEAR(loaded_depth(large, moved), 1000.0 * loaded_depth(net, hold), 1e-4)
        << "round " << round << ", seed " << kSeed + 1;
  }
}

TEST(Equilibria, AreReachableAndNothingNearThemIsLower) {
  Rng rng(kSeed + 2);
  int several = 0;
  for (int round = 0; round < 300; ++round) {
    const Net net = net_of(random_convex(rng, 3 + static_cast<std::size_t>(rng.below(5))));
    const Cloth cloth{net.rest, random_hold(rng, net.rest)};
    const std::vector<Hanging> all = equilibria(cloth.rest, cloth.hold, 2.0);
    ASSERT_FALSE(all.empty()) << "round " << round << ", seed " << kSeed + 2;
    several += all.size() > 1;
    EXPECT_NEAR(2.0 - all[0].position.z, loaded_depth(net, cloth.hold), 1e-7);
    for (const Hanging& hanging : all) {
      const double depth = 2.0 - hanging.position.z;
      EXPECT_NEAR(cloth.squared_depth(hanging.position.ground(), hanging.contact), depth * depth, 1e-7);
      EXPECT_GE(hanging.taut.size(), hanging.at_edge ? 2u : 3u);
      for (int i = 0; i < 200; ++i) {
        // Very near: a corner may hold it there by next to nothing.
        const Vec2 near = hanging.contact + 1e-5 * Vec2{rng.normal(), rng.normal()};
        if (!geom::contains(cloth.rest, near)) continue;
        EXPECT_LE(cloth.squared_depth(near), depth * depth + 1e-13)
            << "round " << round << ", seed " << kSeed + 2;
      }
    }
  }
  EXPECT_GT(several, 10) << "seed " << kSeed + 2;
}

TEST(HoldingReserve, IsNegativeExactlyWhereALoadRestsAtAnEdge) {
  Rng rng(kSeed + 3);
  int rolls_out = 0;
  for (int round = 0; round < 2000; ++round) {
    const Net net = net_of(random_convex(rng, 3 + static_cast<std::size_t>(rng.below(5))));
    const std::vector<Vec2> hold = random_hold(rng, net.rest);
    const std::vector<Hanging> all = equilibria(net.rest, hold, 2.0);
    const bool at_edge = std::any_of(all.begin(), all.end(), [](const Hanging& h) { return h.at_edge; });
    EXPECT_EQ(holding_reserve(net, hold) < 0.0, at_edge) << "round " << round << ", seed " << kSeed + 3;
    EXPECT_EQ(holding_margin(net, hold) == 0.0, at_edge) << "round " << round << ", seed " << kSeed + 3;
    rolls_out += at_edge;
  }
  EXPECT_GT(rolls_out, 100);
}

TEST(HoldingMargin, OfARegularNetIsItsInradius) {
  for (const std::size_t corners : {3u, 4u, 6u}) {
    const Net net = net_of(regular_polygon(corners, 1.3));
    const std::vector<Vec2> hold = regular_polygon(corners, 1.3 * 0.88);
    EXPECT_NEAR(holding_margin(net, hold), 1.3 * std::cos(std::numbers::pi / static_cast<double>(corners)),
                1e-9);
    EXPECT_GT(holding_reserve(net, hold), 0.5);
  }
}

// Two opposite sides let go, the others tight: a sheared square drops its load over a slack side.
TEST(HoldingMargin, AShearedSquareLosesItsLoad) {
  const Net net = net_of({{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}});
  const std::vector<Vec2> narrowed{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.85}, {0.0, 1.85}};
  EXPECT_NEAR(holding_margin(net, narrowed), 1.0, 1e-9);
  const std::vector<Vec2> sheared{{0.0, 0.0}, {1.0, 0.0}, {1.8, 1.65}, {0.8, 1.65}};
  EXPECT_EQ(holding_margin(net, sheared), 0.0);
  EXPECT_LT(holding_reserve(net, sheared), 0.0);
}

// The three cases of data/vvcm_fk/vectors.json, in millimetres.
const Hanging* nearest(const std::vector<Hanging>& all, geom::Vec3 place) {
  const Hanging* best = nullptr;
  for (const Hanging& h : all)
    if (best == nullptr || geom::norm(h.position - place) < geom::norm(best->position - place)) best = &h;
  return best;
}

std::vector<Hanging> held_inside(const std::vector<Hanging>& all) {
  std::vector<Hanging> inside;
  for (const Hanging& h : all)
    if (!h.at_edge) inside.push_back(h);
  return inside;
}

TEST(Equilibria, ReproduceTheReferenceOfFourRobots) {
  const std::vector<Vec2> hold{{213.7, 122.7}, {804.6, 37.2}, {904.0, 550.0}, {439.3, 715.9}};
  const std::vector<Vec2> rest{{-316.1, -421.9}, {803.4, -384.1}, {746.1, 712.8}, {-367.3, 664.2}};
  const std::vector<Hanging> all = held_inside(equilibria(rest, hold, 1000.0));
  ASSERT_EQ(all.size(), 2u);
  struct Reference {
    geom::Vec3 position;
    Vec2 contact;
    std::vector<int> taut;
  };
  const std::vector<Reference> references{
      {{568.8123, 324.72644, 336.73608}, {238.6181, 125.02439}, {0, 1, 2}},
      {{557.9307, 341.23087, 337.2464}, {208.79898, 152.53357}, {0, 2, 3}}};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(geom::norm(all[i].position - references[i].position), 0.05);
    EXPECT_LT(geom::norm(all[i].contact - references[i].contact), 0.05);
    EXPECT_EQ(all[i].taut, references[i].taut);
  }
}

TEST(Equilibria, ReproduceTheReferenceOfSixRobotsAndItsLowerTwin) {
  std::vector<Vec2> hold{{-27.419184, -176.293854}, {398.141083, -35.190411},  {517.018127, 338.271301},
                         {285.155762, 609.95575},   {-175.608231, 569.463562}, {-301.437988, 194.695297}};
  const std::vector<Vec2> rest{{-131.665741, -376.508026}, {480.675873, -388.066681},
                               {877.700256, 217.088806},   {562.778748, 826.754089},
                               {-107.442101, 918.166626},  {-453.516937, 284.887146}};
  const Vec2 first = hold[0];
  for (Vec2& a : hold) a -= first;
  const std::vector<Hanging> all = held_inside(equilibria(rest, hold, 823.0));
  ASSERT_GE(all.size(), 2u);
  const geom::Vec3 reference{137.674, 420.879, 301.218};
  const geom::Vec3 lower{135.3, 463.3, 300.8};  // given to 0.1 mm
  EXPECT_LT(geom::norm(nearest(all, reference)->position - reference), 0.15);
  EXPECT_LT(geom::norm(nearest(all, lower)->position - lower), 0.15);
  EXPECT_EQ(&all[0], nearest(all, lower));
}

TEST(Equilibria, ThereAreNoneWhenTheClothIsTooShort) {
  const std::vector<Vec2> hold{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::vector<Vec2> rest{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(equilibria(rest, hold, 10.0).empty());
}

}  // namespace
}  // namespace seine::net
