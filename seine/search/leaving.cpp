#include "seine/search/leaving.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "seine/geom/convex.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/vehicle/arc.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kSame = 1e-6;     // m: no nearer than this to the margin is at the margin (world::check)
constexpr double kStep = 0.02;     // car lengths between looks
constexpr double kLongest = 2.0;   // car lengths of one arc
constexpr double kRoom = 0.005;    // car lengths beyond the margin at the end: what the corridor keeps
constexpr double kSharpest = 0.9;  // of the tightest turn
constexpr std::array kTurns{0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0, -1.0};
constexpr std::array kFirst{0.1, 0.2, 0.4, 0.8};  // car lengths of the first of two arcs

class Exit {
 public:
  Exit(const world::Scenario& scenario, const world::StaticMap& map, const world::Robot& robot)
      : map_(map),
        model_(scenario.model_of(robot)),
        start_(robot.start),
        footprint_(model_.footprint),
        margin_(scenario.margins.obstacle + kRoom * model_.length()) {
    const double here = distance(start_), least = scenario.margins.leaving.value_or(here);
    // A little of the room there is stays for the optimiser.
    floor_ = least + 0.1 * std::clamp(here - least, 0.0, kRoom * model_.length()) - kSame;
  }

  std::vector<Path> run() {
    for (const int gear : {1, -1})
      for (const double turn : kTurns) single(gear, turn);
    if (found_.empty())
      for (const int gear : {1, -1})
        for (const double turn : kTurns) twofold(gear, turn);
    std::vector<Path> paths;
    for (auto& [key, path] : found_) paths.push_back(std::move(path));
    std::stable_sort(paths.begin(), paths.end(),
                     [](const Path& a, const Path& b) { return a.length() < b.length(); });
    return paths;
  }

 private:
  double distance(const geom::Pose2& pose) {
    geom::place(model_.footprint, pose, footprint_);
    return map_.distance(footprint_, margin_ + kSame);
  }
  bool may(int gear) const { return gear > 0 || model_.limits.reverse_speed > 0.0; }
  double curvature(double turn) const { return turn * kSharpest * model_.max_curvature(); }

  /// Drives on until the margin is reached (then the length driven), or the floor, or the end.
  double drive(const geom::Pose2& from, double curvature, int gear, double longest) {
    const double step = kStep * model_.length();
    for (double s = step; s <= longest; s += step) {
      const double room = distance(vehicle::drive(from, curvature, gear * s));
      if (room < floor_) return -1.0;
      if (room >= margin_) return s;
    }
    return -1.0;
  }

  void single(int gear, double turn) {
    if (!may(gear)) return;
    const double length = drive(start_, curvature(turn), gear, kLongest * model_.length());
    if (length > 0.0) offer(gear, turn, {{curvature(turn), gear * length}});
  }

  void twofold(int gear, double turn) {
    if (!may(gear) || !may(-gear)) return;
    for (const double share : kFirst) {
      const Arc first{curvature(turn), gear * share * model_.length()};
      const double clear = drive(start_, first.curvature, gear, std::abs(first.distance));
      const geom::Pose2 middle = vehicle::drive(start_, first);
      if (clear < 0.0 && distance(middle) < floor_) return;
      for (const double other : kTurns) {
        const double length = drive(middle, curvature(other), -gear, kLongest * model_.length());
        if (length > 0.0) offer(gear, turn, {first, {curvature(other), -gear * length}});
      }
    }
  }

  void offer(int gear, double turn, const std::vector<Arc>& arcs) {
    Path path;
    geom::Pose2 from = start_;
    double driven = 0.0;
    for (const Arc& arc : arcs) {
      const double length = std::abs(arc.distance);
      const int steps = std::max(1, static_cast<int>(std::ceil(length / (kPathSpacing * model_.length()))));
      for (int i = 0; i <= steps; ++i) {
        const double s = length * i / steps;
        path.points.push_back(
            {driven + s, vehicle::drive(from, arc.curvature, arc.gear() * s), arc.curvature, arc.gear()});
      }
      from = path.points.back().pose, driven += length;
    }
    const std::pair key{gear, turn > 0.0 ? 1 : turn < 0.0 ? -1 : 0};
    const auto [entry, fresh] = found_.try_emplace(key, path);
    if (!fresh && path.length() < entry->second.length()) entry->second = std::move(path);
  }

  const world::StaticMap& map_;
  const vehicle::Model& model_;
  geom::Pose2 start_;
  std::vector<geom::Vec2> footprint_;
  double margin_, floor_;
  std::map<std::pair<int, int>, Path> found_;  // by gear and side
};

}  // namespace

bool starts_inside_margin(const world::Scenario& scenario, const world::StaticMap& map,
                          const world::Robot& robot) {
  const double margin = scenario.margins.obstacle;
  if (scenario.margins.leaving.value_or(margin) >= margin) return false;
  const std::vector<geom::Vec2>& body = scenario.model_of(robot).footprint;
  std::vector<geom::Vec2> footprint(body.size());
  geom::place(body, robot.start, footprint);
  return map.distance(footprint, margin) < margin - kSame;
}

std::vector<Path> ways_out(const world::Scenario& scenario, const world::StaticMap& map,
                           const world::Robot& robot) {
  return Exit(scenario, map, robot).run();
}

}  // namespace seine::search
