#include "seine/search/path.hpp"

#include <algorithm>

#include "seine/vehicle/arc.hpp"

namespace seine::search {

void append(Path& path, const Path& next, bool rest) {
  const double length = path.length();
  if (path.points.empty() || next.points.empty()) return;
  const bool same_gear = next.points.front().gear == path.points.back().gear;
  if (same_gear) path.points.pop_back();
  for (const PathPoint& point : next.points) {
    path.points.push_back(point);
    path.points.back().s += length;
  }
  if (rest) path.rests.push_back(length);
  for (const double at : next.rests) path.rests.push_back(at + length);
}

geom::Pose2 pose_at(const Path& path, double s) {
  const auto& points = path.points;
  if (points.empty()) return {};
  const auto after = std::upper_bound(points.begin(), points.end(), s,
                                      [](double value, const PathPoint& p) { return value < p.s; });
  if (after == points.begin()) return points.front().pose;
  if (after == points.end()) return points.back().pose;
  const PathPoint& from = *(after - 1);
  const double step = after->s - from.s;  // > 0: `after` is the first point beyond s
  // The arc's curvature comes from the headings, not from the label: both ends are met even where labels are
  // rounded.
  const double turn = geom::wrap_angle(after->pose.heading - from.pose.heading);
  return vehicle::drive(from.pose, turn / (from.gear * step), from.gear * (s - from.s));
}

ProfileKnot TimedPath::at(double t) const {
  if (profile.empty()) return {t, 0.0, 0.0};
  const auto after = std::upper_bound(profile.begin(), profile.end(), t,
                                      [](double value, const ProfileKnot& k) { return value < k.t; });
  if (after == profile.begin()) return {t, profile.front().s, profile.front().v};
  if (after == profile.end()) return {t, profile.back().s, profile.back().v};
  const ProfileKnot& from = *(after - 1);
  const double acceleration = (after->v - from.v) / (after->t - from.t);
  const double elapsed = t - from.t;
  const double s = from.s + elapsed * (from.v + 0.5 * acceleration * elapsed);
  return {t, std::clamp(s, from.s, std::max(from.s, after->s)), from.v + acceleration * elapsed};
}

}  // namespace seine::search
