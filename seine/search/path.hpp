#pragma once

#include <vector>

#include "seine/geom/pose2.hpp"

namespace seine::search {

/// A point of a driveable path.
struct PathPoint {
  double s = 0.0;  ///< m, driven length from the start, grows in either gear
  geom::Pose2 pose;
  double curvature =
      0.0;  ///< κ, 1/m, of the front wheel on the stretch that starts here; |κ| is what limits the speed
  int gear = 1;  ///< η of the stretch that starts here
};

/// A driveable curve of arcs and straights with gear changes, densely sampled (consecutive points at most
/// `spacing` apart). The last point of a stretch in one gear and the first of the next are two points with
/// the same s and pose and different gear.
struct Path {
  std::vector<PathPoint> points;
  std::vector<double> rests;  ///< m, ascending: driven lengths, each that of a point, at which the car stops
  /// Whether it is the quickest of many ways out of a tight place or into one: no other search need be tried.
  bool wriggles = false;
  double length() const { return points.empty() ? 0.0 : points.back().s; }
};

/// A knot of a speed profile: at time t the car has driven s and has speed v ≥ 0 (unsigned); between knots
/// the acceleration is constant.
struct ProfileKnot {
  double t = 0.0;
  double s = 0.0;
  double v = 0.0;
};

/// A path and when the car is where on it: starts at t = 0, ends at rest at the path's end; v = 0 at every
/// gear change. A car that stands the whole time has a path of one point.
struct TimedPath {
  Path path;
  std::vector<ProfileKnot> profile;
  double arrival() const { return profile.empty() ? 0.0 : profile.back().t; }
  bool stands() const { return path.points.size() <= 1; }
  /// Driven length and speed at time t; before 0 and after arrival the end values.
  ProfileKnot at(double t) const;
};

/// Drives on along `next`, which begins where `path` ends.
/// @param rest  whether the car stops there, whatever its gears
void append(Path& path, const Path& next, bool rest = false);

/// Pose on the path at driven length s (clamped), interpolated between samples.
geom::Pose2 pose_at(const Path& path, double s);

}  // namespace seine::search
