#include "seine/search/side_step.hpp"

#include <algorithm>
#include <cmath>

#include "seine/search/path_planner.hpp"
#include "seine/search/route.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

// In car lengths: the way to get beside the path and back. Shorter transitions
// turn tighter and slow the car down, longer ones seldom find room.
constexpr double kTransition = 3.0;
constexpr double kShortest = 1.2;
constexpr double kRadius =
    1.1;  // of the smallest turning radius: room for the optimiser, as in the path search
constexpr double kSlack = 0.025;  // car lengths

// The largest share of the gentlest arcs that two opposite turns over (distance, offset) allow.
double turning_radius(double distance, double offset, double smallest) {
  constexpr double kShare = 0.8;
  return std::max(smallest, kShare * (distance * distance + offset * offset) / (4.0 * std::abs(offset)));
}

// Arcs straight ahead: gentle if possible, tight where the path itself bends.
bool append_forward(const geom::Pose2& from, const geom::Pose2& to, double gentle, double tight,
                    std::vector<vehicle::Arc>& arcs) {
  for (const double radius : {gentle, tight}) {
    const vehicle::ReedsSheppPath word =
        vehicle::reeds_shepp(from, to, radius, {.reverse = 4.0, .gear_change = 4.0 * radius});
    // Forward words that go round in a circle are no side steps.
    constexpr double kLongest = 1.5;
    if (word.length > kLongest * norm(to.position() - from.position())) continue;
    const auto ahead = [](const vehicle::Arc& arc) { return arc.distance >= 0.0; };
    if (!std::all_of(word.arcs().begin(), word.arcs().end(), ahead)) continue;
    arcs.insert(arcs.end(), word.arcs().begin(), word.arcs().end());
    return true;
  }
  return false;
}

// [begin, end) of the stretch in one gear that holds s.
std::pair<double, double> stretch_around(const Path& path, double s) {
  std::pair<double, double> stretch{0.0, path.length()};
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    if (path.points[i].gear == path.points[i + 1].gear) continue;
    if (path.points[i].s <= s) stretch.first = path.points[i].s;
    if (path.points[i].s > s) {
      stretch.second = path.points[i].s;
      break;
    }
  }
  return stretch;
}

int gear_at(const Path& path, double s) {
  const auto after = std::upper_bound(path.points.begin(), path.points.end(), s,
                                      [](double value, const PathPoint& p) { return value < p.s; });
  return after == path.points.begin() ? path.points.front().gear : std::prev(after)->gear;
}

// The path with what lies between s_from and s_to, on one stretch, replaced.
Path spliced(const Path& path, double s_from, const Path& middle, double s_to) {
  const int gear = middle.points.front().gear;
  Path result;
  for (const PathPoint& p : path.points)
    if (p.s < s_from || (p.s == s_from && p.gear != gear)) result.points.push_back(p);
  for (PathPoint p : middle.points) {
    p.s += s_from;
    result.points.push_back(p);
  }
  const double shift = s_from + middle.length() - s_to;
  for (PathPoint p : path.points) {
    if (p.s < s_to || (p.s == s_to && p.gear == gear)) continue;
    p.s += shift;
    result.points.push_back(p);
  }
  return result;
}

}  // namespace

SideStep::SideStep(const world::StaticMap& map, const vehicle::Model& model, double clearance)
    : model_(model),
      distances_(map, 0.35 * model.width(), 1.5 * model.length()),
      checker_(map, &distances_, model_, clearance) {
  checker_.set_slack(kSlack * model.length());
}

std::optional<Path> SideStep::around(const Path& path, double s, double offset, double beside_for) const {
  const double length = model_.length();
  const auto [begin, end] = stretch_around(path, s);
  const double first = std::max(s - beside_for, begin + kShortest * length);
  const double last = std::min(s + beside_for, end - kShortest * length);
  if (first > last || gear_at(path, s) < 0) return std::nullopt;
  const double from = std::max(first - kTransition * length, begin),
               to = std::min(last + kTransition * length, end);
  const auto beside = [&](double at) {
    const geom::Pose2 pose = pose_at(path, at);
    const geom::Vec2 p = pose * geom::Vec2{0.0, offset};
    return geom::Pose2{p.x, p.y, pose.heading};
  };
  const double smallest = kRadius / model_.max_curvature();
  Route route{pose_at(path, from), pose_at(path, to), {}};
  const geom::Pose2 in = beside(first), out = beside(last);
  if (!append_forward(route.start, in, turning_radius(first - from, offset, smallest), smallest, route.arcs))
    return std::nullopt;
  if (last - first > 0.1 * length && !append_forward(in, out, 2.0 * smallest, smallest, route.arcs))
    return std::nullopt;
  const geom::Pose2& then = last - first > 0.1 * length ? out : in;
  if (!append_forward(then, route.goal, turning_radius(to - last, offset, smallest), smallest, route.arcs))
    return std::nullopt;
  if (sweep(checker_, route.start, checker_.room(route.start), route.arcs) < 0.0) return std::nullopt;
  return spliced(path, from, sampled(route, kPathSpacing * length), to);
}

}  // namespace seine::search
