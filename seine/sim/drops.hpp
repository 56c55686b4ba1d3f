#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"
#include "seine/sim/catch_watch.hpp"
#include "seine/sim/cord_net.hpp"
#include "seine/world/net_families.hpp"

namespace seine::sim {

/// The corners of a net of the families, held still, open to `opening`.
inline std::vector<geom::Vec3> held(const net::Net& net, double opening) {
  std::vector<geom::Vec3> corners;
  for (const geom::Vec2 r : net.rest) corners.push_back({opening * r.x, opening * r.y, net.rim()});
  return corners;
}

inline std::vector<geom::Vec2> on_ground(const std::vector<geom::Vec3>& corners) {
  std::vector<geom::Vec2> ground;
  for (const geom::Vec3 corner : corners) ground.push_back(corner.ground());
  return ground;
}

/// An object that falls through the rim of a net held still.
struct Drop {
  net::Target target;
  net::Catch measured;
};

struct DropRange {
  double slowest = 3.0, fastest = 11.0;                       ///< m/s at the rim
  double steepest = 0.0, flattest = 0.25 * std::numbers::pi;  ///< rad from straight down
  double margin = 0.0;  ///< m, of the crossing point to the nearest edge
};

inline Drop random_drop(Rng& rng, const net::Net& net, const std::vector<geom::Vec2>& hold,
                        const DropRange& range) {
  constexpr double kAbove = 0.05;  // s before the rim
  const double speed = rng.uniform(range.slowest, range.fastest);
  const double angle = rng.uniform(range.steepest, range.flattest);
  const geom::Vec2 side =
      speed * std::sin(angle) * geom::unit(rng.uniform(-std::numbers::pi, std::numbers::pi));
  const double reach = 1.5;
  geom::Vec2 at;
  do {
    at = {rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
  } while (net::margin_inside(hold, at) < range.margin);
  const geom::Vec3 velocity{side.x, side.y, -speed * std::cos(angle)};
  Drop drop;
  drop.target.mass = std::vector<double>{0.1, 0.25, 0.5}[static_cast<std::size_t>(rng.below(3))];
  drop.target.position = geom::Vec3{at.x, at.y, net.rim()} + (-kAbove) * velocity +
                         geom::Vec3{0.0, 0.0, -0.5 * net::kGravity * kAbove * kAbove};
  drop.target.velocity = velocity + geom::Vec3{0.0, 0.0, net::kGravity * kAbove};
  const auto crossing = net::Flight(drop.target).crossing(net.rim());
  drop.measured = net::measure_catch(net, drop.target, *crossing, hold, {});
  return drop;
}

/// Whether the certificate would sign it.
inline bool certified(const net::Net& net, const Drop& drop) {
  const net::Catch& c = drop.measured;
  return c.rim_margin >= net::kRimMargin && c.contact_margin >= net::kContactMargin &&
         c.opening >= net::kLeastOpening - 1e-9 && c.angle <= net::kMaxAngle &&
         c.speed <= net::speed_limit(c.depth, drop.target.radius, net.rebound) && c.bottom >= net.clearance;
}

inline Ball ball_of(const net::Target& target) {
  return {.position = target.position,
          .velocity = target.velocity,
          .radius = target.radius,
          .mass = target.mass,
          .drag = target.drag};
}

/// Speed after the first bounce / speed before, both where the object would hang at rest: from how high it
/// rises above that place.
inline double rebound(NetPhysics& physics, const std::vector<geom::Vec3>& corners, const net::Net& net,
                      const Drop& drop) {
  const std::size_t ball = physics.add(ball_of(drop.target));
  const double hanging = net.rim() - drop.measured.depth + drop.target.radius;
  bool rising = false;
  for (int i = 0; i < 3000; ++i) {
    physics.advance(corners, 1e-3);
    const double up = physics.ball(ball).velocity.z;
    if (rising && up <= 0.0) break;
    rising = rising || (physics.touching(ball) && up > 0.0);
  }
  const double rise = physics.ball(ball).position.z - hanging;
  const double falling = drop.measured.speed * std::cos(drop.measured.angle);
  const double before = falling * falling + 2.0 * net::kGravity * (net.rim() - hanging);
  return std::sqrt(std::max(0.0, 2.0 * net::kGravity * rise / before));
}

/// Lets it happen: until the object is lost, did not come to rest in time, or has been caught for a while.
inline CatchWatch watch_drop(NetPhysics& physics, const std::vector<geom::Vec3>& corners, const Drop& drop) {
  constexpr double kAfterwards = 0.4;  // s
  CatchWatch watch(physics.add(ball_of(drop.target)), corners.front().z);
  watch.look(0.0, physics, corners);
  double time = 0.0;
  while (!watch.lost() && watch.fate() != Fate::restless && time < 5.0) {
    physics.advance(corners, 1e-3);
    watch.look(time += 1e-3, physics, corners);
    if (watch.fate() == Fate::caught && time > watch.catch_time() + kAfterwards) break;
  }
  return watch;
}

}  // namespace seine::sim
