// Where the cars are: distances to obstacles, map, bounds and each other; size and shape of the net.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/deceive/shapes.hpp"
#include "bench/deceive/truth.hpp"

namespace seine::deceive {
namespace {

using geom::Vec2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double reach_of(std::span<const Vec2> body) {
  double reach = 0.0;
  for (const Vec2 p : body) reach = std::max(reach, std::hypot(p.x, p.y));
  return reach;
}

geom::Pose2 obstacle_pose(const world::Obstacle& obstacle, double t) {
  const auto& motion = obstacle.motion;
  if (t <= motion.front().t) return motion.front().pose;
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    if (t > motion[i + 1].t) continue;
    const double share = (t - motion[i].t) / (motion[i + 1].t - motion[i].t);
    const geom::Pose2 &a = motion[i].pose, &b = motion[i + 1].pose;
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
            a.heading + share * std::remainder(b.heading - a.heading, 2.0 * std::acos(-1.0))};
  }
  return motion.back().pose;
}

/// An obstacle in its body frame (or, standing, in the world), with a circle around it.
struct Body {
  const world::Obstacle* obstacle;
  Polygon polygon;  // empty: a disc
  Vec2 center;
  double radius;  // of the disc, or of the circle around the polygon
};

std::vector<Body> bodies_of(const world::Scenario& scenario) {
  std::vector<Body> bodies;
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
      bodies.push_back({&obstacle, {}, circle->center, circle->radius});
      continue;
    }
    const auto& polygon = std::get<Polygon>(obstacle.shape);
    Vec2 center;
    for (const Vec2 p : polygon) center += p / static_cast<double>(polygon.size());
    double radius = 0.0;
    for (const Vec2 p : polygon) radius = std::max(radius, std::hypot(p.x - center.x, p.y - center.y));
    bodies.push_back({&obstacle, polygon, center, radius});
  }
  return bodies;
}

/// Distances to what is nearer than `cap`; else infinity.
double distance_to(const Body& body, const Polygon& car, const geom::Pose2& pose, double reach, double t,
                   double cap) {
  const bool moves = !body.obstacle->motion.empty();
  const geom::Pose2 frame = moves ? obstacle_pose(*body.obstacle, t) : geom::Pose2{};
  const Vec2 center = moves ? placed({&body.center, 1}, frame).front() : body.center;
  if (std::hypot(center.x - pose.x, center.y - pose.y) > reach + body.radius + cap) return kInfinity;
  if (body.polygon.empty()) return disc_distance(car, center, body.radius);
  return polygon_distance(car, moves ? placed(body.polygon, frame) : body.polygon);
}

/// What lies outside the picture is unknown, and so an obstacle.
bool solid(const geom::OccupancyGrid& map, int x, int y) {
  if (x < 0 || y < 0 || x >= map.width || y >= map.height) return true;
  return map.occupied[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(x)] != 0;
}

/// To the nearest solid cell, cell by cell.
double distance_to_cells(const geom::OccupancyGrid& map, const Polygon& car, const geom::Pose2& pose,
                         double reach, double cap) {
  const double c = std::cos(map.origin.heading), s = std::sin(map.origin.heading);
  const double dx = pose.x - map.origin.x, dy = pose.y - map.origin.y;
  const double column = (c * dx + s * dy) / map.resolution, row = (c * dy - s * dx) / map.resolution;
  const double around = (reach + cap) / map.resolution + 1.0;
  const auto first = static_cast<int>(std::floor(column - around)),
             last = static_cast<int>(std::ceil(column + around)),
             bottom = static_cast<int>(std::floor(row - around)),
             top = static_cast<int>(std::ceil(row + around));
  double least = kInfinity;
  for (int y = bottom; y <= top; ++y) {
    for (int x = first; x <= last; ++x) {
      if (!solid(map, x, y)) continue;
      const double r = map.resolution, l = x * r, b = y * r;
      const Vec2 cell[4] = {{l, b}, {l + r, b}, {l + r, b + r}, {l, b + r}};
      least = std::min(least, convex_distance(car, placed(cell, map.origin)));
    }
  }
  return least;
}

double distance_to_bounds(const geom::Box& bounds, const Polygon& car) {
  double least = kInfinity;
  for (const Vec2 p : car)
    least =
        std::min({least, p.x - bounds.low.x, p.y - bounds.low.y, bounds.high.x - p.x, bounds.high.y - p.y});
  return least;
}

double granted_clearance(const Grants& grants, const world::Scenario& scenario) {
  double size = 1.0;
  for (const world::Robot& robot : scenario.robots)
    size = std::min(size, scale_of(scenario.model_of(robot), grants).size);
  return grants.clearance * size;
}

}  // namespace

void look_at_ground(const world::Scenario& scenario, int robot, const traj::RobotTrajectory& way,
                    const std::vector<double>& times, const Grants& grants, Ledger& ledger) {
  const vehicle::Model& model = scenario.model_of(scenario.robots[static_cast<std::size_t>(robot)]);
  const std::vector<Body> bodies = bodies_of(scenario);
  const double reach = reach_of(model.footprint), margin = scenario.margins.obstacle;
  const double granted = granted_clearance(grants, scenario), cap = margin + granted;
  bool left = !scenario.margins.leaving;
  geom::Pose2 before{kInfinity, 0.0, 0.0};
  double still = kInfinity;
  for (const double t : times) {
    const geom::Pose2 pose = pose_at(way, t);
    const bool same = pose.x == before.x && pose.y == before.y && pose.heading == before.heading;
    const Polygon car = placed(model.footprint, pose);
    double moving = kInfinity;
    if (!same) still = distance_to_bounds(scenario.bounds, car);
    for (const Body& body : bodies) {
      const bool moves = !body.obstacle->motion.empty();
      if (!moves && same) continue;
      double& least = moves ? moving : still;
      least = std::min(least, distance_to(body, car, pose, reach, t, cap));
    }
    if (!same && scenario.map)
      still = std::min(still, distance_to_cells(*scenario.map, car, pose, reach, cap));
    left = left || still >= margin;
    const double asked = left ? margin : std::min(margin, *scenario.margins.leaving);
    ledger.offer("overlap of the margin with what stands (m)", t, asked - std::min(still, cap), 0.0, granted);
    ledger.offer("overlap of the margin with what moves (m)", t, margin - std::min(moving, cap), 0.0,
                 granted);
    before = pose;
  }
}

void look_at_pair(const world::Scenario& scenario, int a, int b, const traj::TeamTrajectory& plan,
                  const std::vector<double>& times, const Grants& grants, Ledger& ledger) {
  const std::size_t i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  const vehicle::Model &first = scenario.model_of(scenario.robots[i]),
                       &second = scenario.model_of(scenario.robots[j]);
  const double margin = scenario.margins.robot;
  const double granted = granted_clearance(grants, scenario);
  const double near = reach_of(first.footprint) + reach_of(second.footprint) + margin + granted;
  for (const double t : times) {
    const geom::Pose2 p = pose_at(plan.robots[i], t), q = pose_at(plan.robots[j], t);
    if (std::hypot(p.x - q.x, p.y - q.y) > near) continue;
    const double distance = convex_distance(placed(first.footprint, p), placed(second.footprint, q));
    ledger.offer("overlap of the margin between cars (m)", t, margin - distance, 0.0, granted, b);
  }
}

void look_at_net(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                 const std::vector<double>& times, const Grants&, Ledger& ledger) {
  const net::Net& net = *scenario.net;
  constexpr double kInside = 0.05;  // m, inside the lines of the next ring edges
  const std::size_t n = net.rest.size();
  const double granted = 1.05e-4;  // m
  Polygon ring(n);
  for (const double t : times) {
    for (std::size_t k = 0; k < n; ++k)
      ring[k] = placed({&net.attachments[k].at, 1}, pose_at(plan.robots[k], t)).front();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 p = ring[k], q = ring[(k + 1) % n], edge = q - p;
      const double length = std::hypot(edge.x, edge.y);
      for (const Vec2 v : {ring[(k + 2) % n], ring[(k + n - 1) % n]}) {
        const double depth = (edge.x * (v.y - p.y) - edge.y * (v.x - p.x)) / length;
        ledger.offer("the net's ring folds (m)", t, kInside - depth, 0.0, granted);
      }
      for (std::size_t l = k + 1; l < n; ++l) {
        const Vec2 rest = net.rest[l] - net.rest[k];
        ledger.offer("two attachments too far apart (m)", t, std::hypot(ring[l].x - p.x, ring[l].y - p.y),
                     net.stretch * std::hypot(rest.x, rest.y), granted);
      }
    }
  }
}

}  // namespace seine::deceive
