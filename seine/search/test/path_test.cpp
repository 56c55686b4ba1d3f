#include "seine/search/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "seine/vehicle/arc.hpp"

namespace seine::search {
namespace {

/// Half a metre of left turn forwards, then 0.3 m backwards to the right, in samples of 0.1 m.
Path cusp_path() {
  Path path;
  geom::Pose2 pose{1.0, 2.0, 3.0};
  double s = 0.0;
  const auto stretch = [&](int gear, double curvature, int steps) {
    for (int i = 0; i <= steps; ++i) {
      const double along = 0.1 * i;
      path.points.push_back({s + along, vehicle::drive(pose, curvature, gear * along), curvature, gear});
    }
    pose = path.points.back().pose;
    s = path.points.back().s;
  };
  stretch(+1, 1.5, 5);
  stretch(-1, -2.0, 3);
  return path;
}

TEST(Drive, AQuarterCircle) {
  const auto end = vehicle::drive({0, 0, 0}, 0.5, std::numbers::pi);
  EXPECT_NEAR(end.x, 2.0, 1e-14);
  EXPECT_NEAR(end.y, 2.0, 1e-14);
  EXPECT_NEAR(end.heading, std::numbers::pi / 2, 1e-14);
}

TEST(Drive, SeriesMeetsQuotient) {
  for (const double curvature : {1.9e-3, 2.1e-3, 0.0}) {
    const auto whole = vehicle::drive({0, 0, 0.3}, curvature, 1.0);
    const auto halves = vehicle::drive(vehicle::drive({0, 0, 0.3}, curvature, 0.4), curvature, 0.6);
    EXPECT_NEAR(whole.x, halves.x, 1e-15);
    EXPECT_NEAR(whole.y, halves.y, 1e-15);
  }
}

TEST(PoseAt, IsExactOnArcsInBothGears) {
  const Path path = cusp_path();
  const geom::Pose2 start{1.0, 2.0, 3.0};
  const geom::Pose2 cusp = vehicle::drive(start, 1.5, 0.5);
  for (double s = 0.0; s <= 0.8; s += 0.013) {
    const auto expected = s <= 0.5 ? vehicle::drive(start, 1.5, s) : vehicle::drive(cusp, -2.0, -(s - 0.5));
    const auto pose = pose_at(path, s);
    EXPECT_NEAR(pose.x, expected.x, 1e-12) << s;
    EXPECT_NEAR(pose.y, expected.y, 1e-12) << s;
    EXPECT_NEAR(geom::wrap_angle(pose.heading - expected.heading), 0.0, 1e-12) << s;
  }
}

TEST(PoseAt, ClampsOutside) {
  const Path path = cusp_path();
  EXPECT_EQ(pose_at(path, -1.0), path.points.front().pose);
  EXPECT_EQ(pose_at(path, 9.0), path.points.back().pose);
  EXPECT_EQ(pose_at(Path{}, 0.0), geom::Pose2{});
}

TEST(TimedPath, InterpolatesWithConstantAcceleration) {
  const TimedPath timed{
      cusp_path(), {{0.0, 0.0, 0.0}, {1.0, 0.25, 0.5}, {2.0, 0.5, 0.0}, {3.0, 0.5, 0.0}, {4.2, 0.8, 0.0}}};
  EXPECT_DOUBLE_EQ(timed.arrival(), 4.2);
  EXPECT_DOUBLE_EQ(timed.at(-1.0).s, 0.0);
  EXPECT_DOUBLE_EQ(timed.at(0.5).s, 0.0625);
  EXPECT_DOUBLE_EQ(timed.at(0.5).v, 0.25);
  EXPECT_DOUBLE_EQ(timed.at(2.5).s, 0.5);
  EXPECT_DOUBLE_EQ(timed.at(99.0).s, 0.8);
  EXPECT_DOUBLE_EQ(timed.at(99.0).v, 0.0);
}

}  // namespace
}  // namespace seine::search
