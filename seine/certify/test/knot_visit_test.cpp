// u that comes nearer to a knot than anything is resolved may still pass it, and the curve goes on elsewhere.
#include <gtest/gtest.h>

#include "seine/certify/test/brute_force.hpp"

namespace seine::certify::test {
namespace {

/// Two straight pieces of 1 m: along x from the origin, and on from there, or from `elsewhere`.
traj::Segment two_pieces(Vec2 elsewhere) {
  traj::Segment segment;
  segment.curve = {{Quintic{0.0, 1.0}, Quintic{}}, {Quintic{elsewhere.x, 1.0}, Quintic{elsewhere.y}}};
  segment.piece_duration = 0.5;
  return segment;
}

/// Whether a car may stand about the knot while u goes from one side of it by `depth` to the other and back.
bool may_visit(Vec2 elsewhere, double depth) {
  traj::Segment segment = two_pieces(elsewhere);
  for (int i = 0; i < 6; ++i) {
    const double from = i % 2 == 0 ? 1.0 + depth : 1.0 - depth;
    segment.progress.push_back(hermite({from, 0.0, 0.0}, {2.0 - from, 0.0, 0.0}));
  }
  const traj::TeamTrajectory plan{{{{segment}}}};
  const world::Scenario scenario = scenario_for(plan, car(), 50.0);
  return certify(scenario, world::StaticMap(scenario), plan).holds;
}

TEST(KnotVisit, IsSeenHoweverShort) {
  for (const double depth : {1e-12, 6e-13, 4.9e-13, 4e-13, 1e-13, 1e-14, 1e-15, 4.5e-16}) {
    for (const double sign : {1.0, -1.0}) {
      EXPECT_FALSE(may_visit({5.0, 5.0}, sign * depth)) << sign * depth;
      EXPECT_TRUE(may_visit({1.0, 0.0}, sign * depth)) << sign * depth;
    }
  }
}

}  // namespace
}  // namespace seine::certify::test
