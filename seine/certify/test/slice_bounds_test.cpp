// The bounds on slices against a dense look at motions whose accelerations are as large as they are said to
// be.
#include "seine/certify/slice_bounds.hpp"

#include <gtest/gtest.h>

#include "seine/certify/chart.hpp"
#include "seine/certify/height.hpp"
#include "seine/certify/test/net_plans.hpp"

namespace seine::certify::test {
namespace {

/// Attachments that accelerate evenly or swing round a circle, seen on a slice.
class Swarm {
 public:
  Swarm(Rng& rng, std::size_t count, double width, double bend) : width_(width) {
    const double turned = rng.uniform(0.0, 6.0), drive = rng.uniform(0.0, 5.0);
    for (std::size_t k = 0; k < count; ++k) {
      const double angle =
          turned + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
      const Vec2 middle = geom::unit(angle) + Vec2{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)};
      const Vec2 velocity = drive * geom::unit(angle + 1.6) + Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)};
      ways_.push_back(
          {middle, velocity, rng.uniform(0.0, bend) * geom::unit(rng.uniform(-3, 3)), rng.below(2) == 0});
      bends_.push_back(geom::norm(ways_.back().acceleration));
    }
    from_ = at(0.0), to_ = at(width);
  }

  std::vector<Vec2> at(double t) const {
    const double s = t - 0.5 * width_;
    std::vector<Vec2> out;
    for (const Way& way : ways_) {
      const double turn = geom::norm(way.acceleration);
      const Vec2 off = way.swings ? -std::cos(s) * way.acceleration : 0.5 * s * s * way.acceleration;
      out.push_back(way.middle + s * way.velocity + (turn > 0.0 ? off : Vec2{}));
    }
    return out;
  }
  Slice slice(bool loaded) {
    beat_ = {.t0 = 0.0, .t1 = width_, .loaded = loaded};
    return {&beat_, bends_, 0.0, width_, from_, to_};
  }
  std::size_t size() const { return ways_.size(); }

 private:
  struct Way {
    Vec2 middle, velocity, acceleration;
    bool swings;
  };
  double width_;
  std::vector<Way> ways_;
  std::vector<double> bends_;
  std::vector<Vec2> from_, to_;
  Beat beat_;
};

constexpr int kLooks = 200;

/// Where `other` is on the left of the line, m.
double inside(const std::vector<Vec2>& at, std::size_t i, std::size_t j, std::size_t other) {
  const Vec2 edge = at[j] - at[i];
  return geom::cross(edge, at[other] - at[i]) / geom::norm(edge);
}

TEST(SliceBounds, HoldBetweenTheEnds) {
  Rng rng(51);
  for (int trial = 0; trial < 400; ++trial) {
    const double width = rng.uniform(0.05, 0.5);
    Swarm swarm(rng, static_cast<std::size_t>(3 + rng.below(3)), width, rng.uniform(0.0, 10.0));
    const Slice slice = swarm.slice(false);
    double far = 0.0, near = 1e9, left = 1e9, area = 1e9, dot = -1e9;
    for (int l = 0; l <= kLooks; ++l) {
      const auto at = swarm.at(width * l / kLooks);
      far = std::max(far, geom::norm(at[0] - at[2]));
      near = std::min(near, geom::squared_norm(at[0] - at[2]));
      dot = std::max(dot, geom::dot(at[0] - at[2], at[1] - at[2]));
      left = std::min(left, inside(at, 0, 1, 2));
      double twice = 0.0;
      for (std::size_t k = 0; k < at.size(); ++k) twice += geom::cross(at[k], at[(k + 1) % at.size()]);
      area = std::min(area, 0.5 * twice);
    }
    EXPECT_GE(furthest_apart(slice, 0, 2), far - 1e-12);
    EXPECT_LE(least_square_apart(slice, 0, 2), near + 1e-12);
    EXPECT_LE(least_area(slice), area + 1e-12);
    EXPECT_GE(largest_dot(slice, 0, 1, 2), dot - 1e-12);
    for (const double more : {1e-9, 0.01, 0.1, 1.0}) EXPECT_FALSE(stays_inside(slice, 0, 1, 2, left + more));
  }
}

TEST(SliceBounds, AreTightOnShortSlices) {
  // The slack falls with the square of the width.
  Rng rng(52);
  for (int trial = 0; trial < 100; ++trial) {
    const double width = 1e-3;
    Swarm swarm(rng, 4, width, 10.0);
    const Slice slice = swarm.slice(false);
    const auto from = swarm.at(0.0), to = swarm.at(width);
    EXPECT_LE(furthest_apart(slice, 0, 2),
              std::max(geom::norm(from[0] - from[2]), geom::norm(to[0] - to[2])) + 1e-5);
    const double left = std::min(inside(from, 0, 1, 2), inside(to, 0, 1, 2));
    // (Of what is broken only to first order.)
    EXPECT_TRUE(stays_inside(slice, 0, 1, 2, left - (left > 0.0 ? 1e-3 : 0.05)));
  }
}

TEST(SliceBounds, HeightHoldsBetweenTheEnds) {
  Rng rng(53);
  for (int trial = 0; trial < 300; ++trial) {
    const double width = rng.uniform(0.05, 0.4);
    Swarm swarm(rng, static_cast<std::size_t>(3 + rng.below(2)), width, rng.uniform(0.0, 6.0));
    net::Net net;
    net.rest = regular(static_cast<int>(swarm.size()), rng.uniform(1.2, 2.0));
    net.attachments.assign(swarm.size(), {});
    Height height(net);
    height.at(swarm.at(rng.uniform(0.0, width)));
    const double least = height.least(swarm.slice(trial % 2 == 0));
    double found = 1e9;
    for (int l = 0; l <= kLooks; ++l) {
      const auto at = swarm.at(width * l / kLooks);
      found = std::min(found, 1.0 - net::loaded_depth(net, at));
    }
    EXPECT_LE(least, found + 1e-9);
  }
}

TEST(Chart, BoundsTheAttachmentFarOffTheCar) {
  Rng rng(54);
  for (int trial = 0; trial < 20; ++trial) {
    NetTeam team = random_team(rng, {.corners = 3, .duration = 2.0});
    const Vec2 held_at{-4.0, 2.0};
    for (auto& attachment : team.net().attachments) attachment.at = held_at;
    const world::StaticMap map(team.scenario);
    const Options options;
    Context context{team.scenario, map, options};
    const Chart chart = chart_of(context, 0, team.plan.robots[0], 2.0);
    for (const Cell& cell : chart.mover.cells) {
      const double dt = 1e-4, t = rng.uniform(cell.t0 + dt, cell.t1 - dt);
      const auto at = [&](double when) { return to_world(chart.mover.frame(cell, when), held_at); };
      const Vec2 acceleration = (at(t - dt) - 2.0 * at(t) + at(t + dt)) / (dt * dt);
      EXPECT_LE(geom::norm(acceleration), cell.bend * (1.0 + 1e-6) + 1e-3);
    }
  }
}

}  // namespace
}  // namespace seine::certify::test
