#include "seine/net/catch_rules.hpp"

#include <algorithm>
#include <cmath>

#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"

namespace seine::net {
namespace {

constexpr double kTurned = 0.85;  // of the fastest bounce that stays under the rim

}  // namespace

using geom::Vec2;

double speed_limit(double depth, double radius, double rebound) {
  const double drop = std::max(0.0, depth - radius);
  const double bounce = 1.0 / (rebound * rebound) - 1.0;
  return std::min(kMaxSpeed, kTurned * std::sqrt(2.0 * kGravity * drop * bounce));
}

double stopping_depth(double speed, double radius, double rebound) {
  const double bounce = 1.0 / (rebound * rebound) - 1.0, turned = speed / kTurned;
  return radius + turned * turned / (2.0 * kGravity * bounce);
}

double impact_drop(double speed, double mass) {
  return 0.08 + 0.024 * speed * std::sqrt(mass / 0.25);
}

double carry_speed(double drag) {
  return std::sqrt(kAirPush / drag);  // infinite for 0
}

Catch measure_catch(const Net& net, const Target& target, const Crossing& crossing,
                    std::span<const Vec2> attachments, const Motion& formation) {
  const Vec2 at = crossing.state.position.ground();
  const Vec2 sideways = crossing.state.velocity.ground() - formation.velocity;
  const double falling = -crossing.state.velocity.z;
  const double depth = loaded_depth(net, attachments);
  const double covered = target.radius + crossing.error;
  const Vec2 contact = at + (depth / falling) * sideways;
  // To a team that speeds up, what lies in the net weighs backwards as well; so the air pushes it.
  const Vec2 air = (target.drag * geom::norm(formation.velocity)) * formation.velocity;
  const Vec2 settled = contact - (depth / kGravity) * (formation.acceleration + air);
  const double speed = std::hypot(geom::norm(sideways), falling);
  return {.time = crossing.state.time,
          .rim_margin = margin_inside(attachments, at) - covered,
          .contact_margin =
              std::min(margin_inside(attachments, contact), margin_inside(attachments, settled)) - covered,
          .opening = opening(net, attachments),
          .depth = depth,
          .angle = std::atan2(geom::norm(sideways), falling),
          .speed = speed,
          .bottom = net.rim() - depth - impact_drop(speed, target.mass)};
}

}  // namespace seine::net
