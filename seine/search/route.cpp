#include "seine/search/route.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kStraightPoints = 4096.0, kBentPoints = 1e6;
constexpr double kNoLength = 1e-9;       // m: rounding of closed forms, not a move
constexpr double kSameCurvature = 1e-9;  // 1/m

bool same_stretch(const Arc& a, const Arc& b) {
  return a.gear() == b.gear() && std::abs(a.curvature - b.curvature) < kSameCurvature;
}

double height(const Bump& bump, geom::Vec2 p) {
  const double square = geom::squared_norm(p - bump.center);
  if (square >= bump.radius * bump.radius) return 0.0;
  return bump.weight * (1.0 - std::sqrt(square) / bump.radius);
}

}  // namespace

double RouteCosts::step(const Arc& arc, const Arc* before) const {
  double cost = std::abs(arc.distance) * (arc.distance < 0.0 ? driving.reverse : driving.forward);
  if (before == nullptr) return cost;
  cost += steering_change * radius * std::abs(arc.curvature - before->curvature);
  if (arc.gear() != before->gear()) cost += driving.gear_change;
  return cost;
}

double RouteCosts::bumps_along(const geom::Pose2& from, const Arc& arc) const {
  if (bumps.empty()) return 0.0;
  const double length = std::abs(arc.distance);
  const int samples = 1 + static_cast<int>(length / (0.5 * radius));
  double cost = 0.0;
  for (int i = 0; i < samples; ++i) {
    const geom::Vec2 p = vehicle::drive(from, arc.curvature, arc.distance * (i + 0.5) / samples).position();
    for (const Bump& bump : bumps) cost += height(bump, p) * length / samples;
  }
  return cost;
}

double RouteCosts::of(const geom::Pose2& from, std::span<const Arc> arcs, const Arc* before) const {
  double cost = 0.0, stretch = 0.0;
  geom::Pose2 pose = from;
  // The first stretch may have begun before `from`, so it is never called short unless it starts from rest.
  bool whole = before == nullptr;
  const auto close_stretch = [&] {
    if (whole && stretch < short_stretch) cost += 2.0 * driving.gear_change * (1.0 - stretch / short_stretch);
  };
  for (const Arc& arc : arcs) {
    if (before != nullptr && arc.gear() != before->gear()) {
      close_stretch();
      stretch = 0.0;
      whole = true;
    }
    stretch += std::abs(arc.distance);
    cost += step(arc, before);
    if (!bumps.empty()) {
      cost += bumps_along(pose, arc);
      pose = vehicle::drive(pose, arc);
    }
    before = &arc;
  }
  close_stretch();
  return cost;
}

double sweep(const FootprintChecker& checker, const geom::Pose2& from, double room_from,
             std::span<const Arc> arcs) {
  geom::Pose2 pose = from;
  double room = room_from;
  for (const Arc& arc : arcs) {
    const geom::Pose2 next = vehicle::drive(pose, arc);
    room = checker.sweep(pose, room, arc, next);
    if (room < 0.0) return room;
    pose = next;
  }
  return room;
}

void merge(std::vector<Arc>& arcs) {
  std::size_t kept = 0;
  for (const Arc& arc : arcs) {
    if (std::abs(arc.distance) < kNoLength) continue;
    if (kept > 0 && same_stretch(arcs[kept - 1], arc)) {
      arcs[kept - 1].distance += arc.distance;
    } else {
      arcs[kept++] = arc;
    }
  }
  arcs.resize(kept);
}

Path sampled(const Route& route, double spacing) {
  Path path;
  std::vector<Arc> arcs = route.arcs;
  merge(arcs);
  if (arcs.empty()) {
    path.points.push_back({0.0, route.start, 0.0, 1});
    return path;
  }
  geom::Pose2 pose = route.start;
  double s = 0.0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Arc& arc = arcs[i];
    const double length = std::abs(arc.distance);
    if (i > 0 && arc.gear() != arcs[i - 1].gear()) {
      path.points.push_back({s, pose, arcs[i - 1].curvature, arcs[i - 1].gear()});
    }
    // Of a straight line more would say nothing.
    const double most = arc.curvature == 0.0 ? kStraightPoints : kBentPoints;
    const int steps = static_cast<int>(std::clamp(std::ceil(length / spacing - 1e-9), 1.0, most));
    for (int k = 0; k < steps; ++k) {
      const double along = length * k / steps;
      path.points.push_back(
          {s + along, vehicle::drive(pose, arc.curvature, arc.gear() * along), arc.curvature, arc.gear()});
    }
    s += length;
    pose = vehicle::drive(pose, arc);
  }
  path.points.push_back({s, route.goal, arcs.back().curvature, arcs.back().gear()});
  return path;
}

Route reversed(const Route& route) {
  Route back{route.goal, route.start, {}};
  back.arcs.reserve(route.arcs.size());
  for (auto arc = route.arcs.rbegin(); arc != route.arcs.rend(); ++arc)
    back.arcs.push_back({arc->curvature, -arc->distance});
  return back;
}

}  // namespace seine::search
