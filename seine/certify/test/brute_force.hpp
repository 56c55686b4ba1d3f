#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "seine/certify/certificate.hpp"
#include "seine/certify/test/plans.hpp"
#include "seine/geom/convex.hpp"

namespace seine::certify::test {

/// The largest magnitudes one car reaches on a time grid.
struct Extremes {
  double speed = 0.0, reverse_speed = 0.0;  ///< m/s
  double acceleration = 0.0, lateral_acceleration = 0.0;
  double curvature = 0.0, steering_rate = 0.0;
};

/// The six magnitudes of one state, in the order of Extremes.
inline std::array<double, 6> magnitudes(const traj::State& s, double wheelbase) {
  const double z = wheelbase * s.curvature;
  return {s.speed,
          -s.speed,
          std::abs(s.acceleration),
          std::abs(s.lateral_acceleration),
          std::abs(s.curvature),
          std::abs(wheelbase * s.curvature_rate / (1.0 + z * z))};
}

/// On a grid of `rate` Hz, and a thousand times finer around each extreme (sharp bends are narrower than the
/// grid).
inline Extremes extremes_of(const traj::RobotTrajectory& way, double wheelbase, double rate) {
  std::array<double, 6> most{}, when{};
  const int count = static_cast<int>(way.arrival() * rate);
  for (int i = 0; i <= count; ++i) {
    const auto now = magnitudes(way.at(i / rate), wheelbase);
    for (std::size_t q = 0; q < 6; ++q) {
      if (now[q] > most[q]) most[q] = now[q], when[q] = i / rate;
    }
  }
  for (std::size_t q = 0; q < 6; ++q) {
    for (int i = -1000; i <= 1000; ++i) {
      most[q] = std::max(most[q], magnitudes(way.at(when[q] + i / (1000.0 * rate)), wheelbase)[q]);
    }
  }
  return {most[0], most[1], most[2], most[3], most[4], most[5]};
}

/// Where a moving obstacle's frame is, straight from its definition.
inline geom::Pose2 pose_of(const world::Obstacle& obstacle, double t) {
  const auto& motion = obstacle.motion;
  if (t <= motion.front().t) return motion.front().pose;
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    if (t > motion[i + 1].t) continue;
    const double share = (t - motion[i].t) / (motion[i + 1].t - motion[i].t);
    const geom::Pose2 &a = motion[i].pose, &b = motion[i + 1].pose;
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
            a.heading + share * geom::wrap_angle(b.heading - a.heading)};
  }
  return motion.back().pose;
}

/// The smallest distances of a plan on a time grid.
struct Distances {
  double robots = std::numeric_limits<double>::infinity();
  double statics = std::numeric_limits<double>::infinity();
  double moving = std::numeric_limits<double>::infinity();
  double bounds = std::numeric_limits<double>::infinity();
  double obstacles() const { return std::min({statics, moving, bounds}); }
};

/// Distances at one instant.
inline Distances distances_at(const world::Scenario& scenario, const world::StaticMap& map,
                              const traj::TeamTrajectory& plan, double t) {
  Distances d;
  std::vector<std::vector<Vec2>> placed;
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const auto& body = scenario.model_of(scenario.robots[k]).footprint;
    placed.emplace_back(body.size());
    geom::place(body, plan.robots[k].at(t).pose, placed.back());
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = i + 1; j < placed.size(); ++j)
      d.robots = std::min(d.robots, geom::distance(placed[i], placed[j]));
    for (const auto& piece : map.pieces()) {
      d.statics = std::min(d.statics, geom::distance(placed[i], piece.shape.core) - piece.shape.radius);
    }
    for (const Vec2 p : placed[i]) {
      d.bounds = std::min({d.bounds, p.x - scenario.bounds.low.x, p.y - scenario.bounds.low.y,
                           scenario.bounds.high.x - p.x, scenario.bounds.high.y - p.y});
    }
    for (const auto& obstacle : scenario.obstacles) {  // convex polygons and circles only
      if (obstacle.motion.empty()) continue;
      geom::Convex body;
      if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
        body = {{circle->center}, circle->radius};
      } else {
        body = {std::get<std::vector<Vec2>>(obstacle.shape), 0.0};
      }
      const geom::Convex there = geom::placed(body, pose_of(obstacle, t));
      d.moving = std::min(d.moving, geom::distance(placed[i], there.core) - there.radius);
    }
  }
  return d;
}

inline Distances least_distances(const world::Scenario& scenario, const world::StaticMap& map,
                                 const traj::TeamTrajectory& plan, double begin, double end, double rate) {
  Distances least;
  const int count = static_cast<int>((end - begin) * rate);
  for (int i = 0; i <= count; ++i) {
    const Distances d = distances_at(scenario, map, plan, begin + i / rate);
    least.robots = std::min(least.robots, d.robots);
    least.statics = std::min(least.statics, d.statics);
    least.moving = std::min(least.moving, d.moving);
    least.bounds = std::min(least.bounds, d.bounds);
  }
  return least;
}

inline bool breaks(const Certificate& certificate, Kind kind, int robot = -1) {
  return std::any_of(certificate.violations.begin(), certificate.violations.end(), [&](const Violation& v) {
    return v.kind == kind && (robot < 0 || v.robot == robot || v.other == robot);
  });
}

inline std::string summary(const Certificate& certificate) {
  std::string all = certificate.holds ? "holds" : "broken";
  for (const Violation& v : certificate.violations)
    all += std::string("\n  [") + name_of(v.kind) + "] " + v.text;
  return all;
}

}  // namespace seine::certify::test
