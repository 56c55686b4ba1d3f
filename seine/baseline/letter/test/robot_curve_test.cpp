#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/baseline/letter/robot_curve.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

constexpr std::uint64_t kSeed = 20267;

// Forwards, backwards, forwards; all poses of gear changes and the end are free.
RobotTask shunting(Rng& rng) {
  RobotTask task;
  Vec2 at{0.0, 0.0};
  for (const int gear : {1, -1, 1}) {
    SegmentTask segment{.gear = gear, .piece_duration = rng.uniform(0.3, 1.4)};
    segment.points.push_back(at);
    for (int j = 0; j < 4; ++j)
      segment.points.push_back(at += Vec2{gear * rng.uniform(0.3, 0.6), rng.uniform(-0.1, 0.1)});
    segment.end_heading = rng.uniform(-0.3, 0.3);
    if (!task.segments.empty()) segment.start_heading = task.segments.back().end_heading;
    task.segments.push_back(segment);
  }
  task.free_end = true;
  return task;
}

TEST(RobotCurve, IsTheTrajectoryItWrites) {
  Rng rng(kSeed);
  for (int i = 0; i < 20; ++i) {
    RobotCurve curve(shunting(rng));
    std::vector<double> x(static_cast<std::size_t>(curve.variables()));
    curve.initial(x);
    for (double& v : x) v += 0.05 * rng.normal();
    curve.load(x);
    const traj::RobotTrajectory written = curve.trajectory();
    EXPECT_NEAR(written.arrival(), curve.duration(), 1e-12);
    for (int j = 0; j <= 200; ++j) {
      const double t = curve.duration() * (j + 0.5) / 200.0;
      const Place place = curve.locate(t);
      const traj::State state = written.at(t);
      EXPECT_NEAR(place.position.x, state.pose.x, 1e-9);
      EXPECT_NEAR(place.position.y, state.pose.y, 1e-9);
      EXPECT_NEAR(
          std::abs(geom::wrap_angle(std::atan2(place.direction.y, place.direction.x) - state.pose.heading)),
          0.0, 1e-9);
      if (place.arrived) continue;
      EXPECT_NEAR(place.speed, std::abs(state.speed), 1e-9);
      const geom::Box hull = curve.hull(place.segment, place.piece).inflated(1e-9);
      EXPECT_TRUE(place.position.x >= hull.low.x && place.position.x <= hull.high.x);
      EXPECT_TRUE(place.position.y >= hull.low.y && place.position.y <= hull.high.y);
    }
  }
}

// Continuous up to the fourth derivative at waypoints is what makes it the minimum-jerk spline [Wang22].
TEST(RobotCurve, HasContinuousSnapAtItsWaypoints) {
  Rng rng(kSeed);
  RobotCurve curve(shunting(rng));
  std::vector<double> x(static_cast<std::size_t>(curve.variables()));
  curve.initial(x);
  curve.load(x);
  for (const traj::Segment& segment : curve.trajectory().segments)
    for (std::size_t j = 1; j < segment.curve.size(); ++j)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const traj::Quintic &a = segment.curve[j - 1][axis], &b = segment.curve[j][axis];
        double factorial = 1.0;
        for (std::size_t order = 0; order <= 4; ++order) {
          double end = 0.0;  // the derivative of a at w = 1
          for (std::size_t k = order; k < 6; ++k) {
            double factor = 1.0;
            for (std::size_t m = 0; m < order; ++m) factor *= static_cast<double>(k - m);
            end += factor * a[k];
          }
          if (order > 0) factorial *= static_cast<double>(order);
          EXPECT_NEAR(end, factorial * b[order], 1e-8) << "derivative " << order;
        }
      }
}

}  // namespace
}  // namespace seine::baseline::letter
