#include "seine/world/net_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "seine/geom/blocked.hpp"
#include "seine/geom/convex.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/hanging.hpp"
#include "seine/net/shape.hpp"
#include "seine/world/check_parts.hpp"
#include "seine/world/flight_path.hpp"

namespace seine::world {
namespace {

using geom::Convex;
using geom::Vec2;

constexpr double kTolerance = 1e-6;  // m

std::string place(Vec2 p) {
  return "(" + number(p.x) + ", " + number(p.y) + ")";
}

bool check_rest(const net::Net& net, Complaints& out) {
  if (const std::string why = geom::why_not_simple(net.rest); !why.empty()) {
    out.push_back("the net at rest is not a simple polygon: " + why);
  } else if (geom::signed_area(net.rest) < 0.0) {
    out.push_back("the net at rest is clockwise, expected counter-clockwise");
  } else if (!geom::is_convex(net.rest)) {
    out.push_back("the net at rest is not convex");
  } else {
    return true;
  }
  return false;
}

bool check_numbers(const net::Net& net, Complaints& out) {
  bool fine = require_limit(net.stretch > 0.0 && net.stretch < 1.0, "the net's stretch limit", net.stretch,
                            "a number between 0 and 1", out);
  fine &= require(net.rebound > 0.0 && net.rebound < 1.0, "the net's rebound", net.rebound,
                  "a number between 0 and 1", out);
  fine &= require_limit(net.clearance >= 0.0, "the net's clearance", net.clearance, "zero or more", out);
  fine &= require(net.rim() > 0.0 && std::isfinite(net.rim()), "the height of the net's rim", net.rim(),
                  "a positive number", out);
  for (const net::Attachment& a : net.attachments) {
    if (a.height == net.rim()) continue;
    out.push_back("the net is held at " + metres(net.rim()) + " and at " + metres(a.height) +
                  ", expected one height");
    return false;
  }
  return fine;
}

// Whether the net and the team belong together and can be judged any further.
bool check_team(const Scenario& scenario, Complaints& out) {
  const net::Net& net = *scenario.net;
  const std::size_t robots = scenario.robots.size();
  if (net.rest.size() != robots || net.attachments.size() != robots || robots < 3) {
    out.push_back("the net has " + std::to_string(net.rest.size()) + " corners and " +
                  std::to_string(net.attachments.size()) + " attachments for " + std::to_string(robots) +
                  " robots, expected one each and three or more");
    return false;
  }
  const bool sound = check_rest(net, out);
  return check_numbers(net, out) && sound;
}

// The net held by cars that stand still.
struct Stand {
  const char* when;  // "at the start"
  std::vector<Vec2> corners;
  bool loaded;
};

Stand stand_at_start(const Scenario& scenario) {
  Stand stand{"at the start", {}, scenario.payload.has_value()};
  for (std::size_t k = 0; k < scenario.robots.size(); ++k)
    stand.corners.push_back(scenario.robots[k].start * scenario.net->attachments[k].at);
  return stand;
}

std::optional<Stand> stand_at_goals(const Scenario& scenario) {
  Stand stand{"at the goals", {}, scenario.payload.has_value() || !scenario.targets.empty()};
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    if (!scenario.robots[k].goal) return std::nullopt;
    stand.corners.push_back(*scenario.robots[k].goal * scenario.net->attachments[k].at);
  }
  return stand;
}

bool finite(const Stand& stand) {
  return std::all_of(stand.corners.begin(), stand.corners.end(),
                     [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

// One sentence on the pair that is worst.
bool check_stretch(const Scenario& scenario, const Stand& stand, Complaints& out) {
  const net::Net& net = *scenario.net;
  double worst = 1.0 + kTolerance;  // of the limit
  std::string said;
  for (std::size_t i = 0; i < net.size(); ++i) {
    for (std::size_t j = i + 1; j < net.size(); ++j) {
      const double apart = geom::norm(stand.corners[i] - stand.corners[j]);
      const double limit = net.stretch * net::rest_distance(net, i, j);
      if (apart <= worst * limit) continue;
      worst = apart / limit;
      said = name_of(scenario.robots[i], i) + " and " + name_of(scenario.robots[j], j) + " hold the net " +
             metres(apart) + " apart " + stand.when + ", beyond its limit of " + metres(limit) + " (" +
             number(net.stretch) + " of " + metres(net::rest_distance(net, i, j)) + ")";
    }
  }
  if (!said.empty()) out.push_back(said);
  return said.empty();
}

// A ring is convex and keeps its order when the corners next to every edge lie on its inner side.
bool check_ring(const Scenario& scenario, const Stand& stand, Complaints& out) {
  const std::size_t n = stand.corners.size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t edge = 0, corner = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 tail = stand.corners[i];
    const Vec2 along = stand.corners[(i + 1) % n] - tail;
    for (const std::size_t j : {(i + 2) % n, (i + n - 1) % n}) {
      const double inside = geom::cross(along, stand.corners[j] - tail) / std::max(geom::norm(along), 1e-12);
      if (inside < least) least = inside, edge = i, corner = j;
    }
  }
  // Convex at every corner, but wound twice round the middle.
  const bool simple = geom::why_not_simple(stand.corners).empty();
  if (least >= net::kConvexMargin - kTolerance && simple) return true;
  const auto name = [&](std::size_t k) { return name_of(scenario.robots[k], k); };
  out.push_back(std::string("the net ") + stand.when +
                " is not convex and counter-clockwise in the order of " + "the robots: " + name(corner) +
                " holds it " + metres(std::abs(least)) + (least < 0.0 ? " outside" : " inside") +
                " the edge from " + name(edge) + " to " + name((edge + 1) % n) + ", expected " +
                metres(net::kConvexMargin) + " inside");
  return false;
}

// What lies under the net and reaches up to it.
struct Under {
  const Scenario& scenario;
  const Stand& stand;
  double bottom;  // m: the lowest point of the net
  Complaints& out;

  void complain(const std::string& what, double height) const {
    const net::Net& net = *scenario.net;
    if (height + net.clearance <= bottom + kTolerance) return;
    if (height >= net.rim()) {
      out.push_back(what + " stands inside the net " + stand.when + ": it is " +
                    (std::isinf(height) ? "infinitely tall" : metres(height) + " tall") + ", the rim is at " +
                    metres(net.rim()));
    } else {
      out.push_back("the net " + std::string(stand.when) + " hangs down to " + metres(bottom) + " over " +
                    what + ", which is " + metres(height) + " tall, nearer than its clearance of " +
                    metres(net.clearance));
    }
  }
};

void check_static_under(const Under& under, const StaticMap& map) {
  const Convex net{under.stand.corners, 0.0};
  std::vector<bool> seen(under.scenario.obstacles.size() + 1, false);  // the last: the map
  // The map has only the rims of its blocked areas: what meets none is wholly inside or wholly outside.
  if (under.scenario.map && geom::is_blocked(*under.scenario.map, net.core.front())) {
    seen.back() = true;
    under.complain("a blocked area of the map", std::numeric_limits<double>::infinity());
  }
  map.for_each_near(net.box(), [&](const StaticMap::Piece& piece) {
    const auto slot = piece.obstacle < 0 ? seen.size() - 1 : static_cast<std::size_t>(piece.obstacle);
    if (seen[slot] || geom::separation(net, piece.shape).distance >= 0.0) return;
    seen[slot] = true;
    const double height =
        piece.obstacle < 0 ? std::numeric_limits<double>::infinity() : under.scenario.obstacles[slot].height;
    under.complain(map.describe(static_cast<int>(&piece - map.pieces().data())), height);
  });
}

void check_moving_under(const Under& under, bool at_start) {
  const Convex net{under.stand.corners, 0.0};
  for (std::size_t i = 0; i < under.scenario.obstacles.size(); ++i) {
    const Obstacle& obstacle = under.scenario.obstacles[i];
    if (obstacle.motion.empty()) continue;
    const geom::Pose2 pose = at_start ? pose_at_start(obstacle.motion) : obstacle.motion.back().pose;
    for (const Convex& part : body_of(obstacle)) {
      if (geom::separation(net, geom::placed(part, pose)).distance >= 0.0) continue;
      under.complain(name_of(obstacle, i) + " (moving)", obstacle.height);
      break;
    }
  }
}

void check_stand(const Scenario& scenario, const StaticMap& map, const Stand& stand, bool at_start,
                 Complaints& out) {
  if (!finite(stand)) return;  // the cars' own complaint
  const bool held = check_stretch(scenario, stand, out);
  if (!check_ring(scenario, stand, out) || !held) return;
  const net::Net& net = *scenario.net;
  const double depth = net::loaded_depth(net, stand.corners);  // no cloth hangs deeper without a load
  const Under under{scenario, stand, net.rim() - depth, out};
  if (under.bottom < net.clearance - kTolerance) {
    out.push_back(std::string(stand.loaded ? "the loaded net " : "the net ") + stand.when + " hangs " +
                  metres(depth) + " below its rim at " + metres(net.rim()) +
                  ", nearer to the ground than its " + "clearance of " + metres(net.clearance));
  }
  check_static_under(under, map);
  check_moving_under(under, at_start);
}

// Whether it is the covariance of anything: symmetric, and no direction with a negative variance.
bool is_covariance(const decltype(net::Target::covariance)& c) {
  const std::size_t n = c.size();
  double scale = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      if (!std::isfinite(c[i][j])) return false;
    scale = std::max(scale, c[i][i]);
  }
  const double rounding = 1e-7 * scale;
  auto rest = c;  // Gaussian elimination: the pivots of a semidefinite matrix are not negative
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < n; ++j)
      if (std::abs(c[k][j] - c[j][k]) > rounding) return false;
    if (rest[k][k] < -rounding) return false;
    for (std::size_t i = k + 1; i < n; ++i) {
      // Without variance there is no correlation either.
      if (rest[k][k] <= rounding && std::abs(rest[i][k]) > std::sqrt(rounding * scale) + rounding)
        return false;
      if (rest[k][k] <= rounding) continue;
      const double factor = rest[i][k] / rest[k][k];
      for (std::size_t j = k; j < n; ++j) rest[i][j] -= factor * rest[k][j];
    }
  }
  return true;
}

bool check_target_numbers(const net::Target& target, const std::string& name, Complaints& out) {
  if (!require(target.radius > 0.0 && std::isfinite(target.radius), "the radius of " + name, target.radius,
               "a positive number", out) ||
      !require(target.mass > 0.0 && std::isfinite(target.mass), "the mass of " + name, target.mass,
               "a positive number", out) ||
      !require(target.drag >= 0.0 && std::isfinite(target.drag), "the drag of " + name, target.drag,
               "zero or more", out)) {
    return false;
  }
  for (const double value : {target.time, target.position.x, target.position.y, target.position.z,
                             target.velocity.x, target.velocity.y, target.velocity.z}) {
    if (!require(std::isfinite(value), "a time, position or velocity of " + name, value, "finite numbers",
                 out))
      return false;
  }
  if (is_covariance(target.covariance)) return true;
  out.push_back("the covariance of " + name +
                " is none: expected finite numbers, symmetric, positive semidefinite");
  return false;
}

void check_target(const Scenario& scenario, const net::Target& target, const std::string& name,
                  Complaints& out) {
  if (!check_target_numbers(target, name, out)) return;
  const double rim = scenario.net->rim();
  const auto crossing = net::Flight(target).crossing(rim);
  if (!crossing) {
    const double below = rim - target.position.z;
    out.push_back(name + (below > 0.0 ? " is released " + metres(below) + " below the rim of the net at " +
                                            metres(rim) + " and never falls through it"
                                      : " never falls through the rim of the net at " + metres(rim)));
  } else if (crossing->state.time < 0.0) {
    out.push_back(name + " falls through the rim of the net at t = " + number(crossing->state.time) +
                  " s, before the plan begins");
  } else if (const auto hit = flight_obstruction(scenario, target, crossing->state.time);
             hit && hit->decided) {
    out.push_back(name + " " + describe(scenario, *hit));
  }
}

bool check_payload_numbers(const net::Payload& payload, Complaints& out) {
  return require(payload.radius > 0.0 && std::isfinite(payload.radius), "the radius of the payload",
                 payload.radius, "a positive number", out) &&
         require(payload.mass > 0.0 && std::isfinite(payload.mass), "the mass of the payload", payload.mass,
                 "a positive number", out);
}

void check_payload(const Scenario& scenario, Complaints& out) {
  const net::Payload& payload = *scenario.payload;
  if (!check_payload_numbers(payload, out)) return;
  const double widest = net::inradius(scenario.net->rest);
  if (payload.radius > widest)
    out.push_back("the payload has a radius of " + metres(payload.radius) +
                  ", wider than the net: spread flat it has room for " + metres(widest));
}

void check_delivery(const Scenario& scenario, const std::optional<Stand>& goals, Complaints& out) {
  const net::Delivery& delivery = *scenario.delivery;
  require(delivery.radius > 0.0 && std::isfinite(delivery.radius), "the radius of the delivery",
          delivery.radius, "a positive number", out);
  if (!scenario.bounds.contains(delivery.center)) {
    out.push_back("the delivery at " + place(delivery.center) + " lies outside the bounds");
  }
  if (goals && finite(*goals)) {
    Vec2 middle;
    for (const Vec2 corner : goals->corners) middle += corner / static_cast<double>(goals->corners.size());
    const double off = geom::norm(middle - delivery.center);
    if (off > delivery.radius + kTolerance) {
      out.push_back("the goals bring the middle of the net to " + place(middle) + ", " + metres(off) +
                    " from the delivery at " + place(delivery.center) + ", beyond its radius of " +
                    metres(delivery.radius));
    }
  }
  for (std::size_t k = 0; k < scenario.robots.size() && delivery.heading; ++k) {
    const auto& goal = scenario.robots[k].goal;
    if (!goal || !(std::abs(geom::wrap_angle(goal->heading - *delivery.heading)) > kDeliveryHeading))
      continue;
    out.push_back("the goal of " + name_of(scenario.robots[k], k) + " has heading " + number(goal->heading) +
                  ", the delivery asks for " + number(*delivery.heading));
  }
}

}  // namespace

void check_net_numbers(const Scenario& scenario, Complaints& out) {
  if (!scenario.net) return;
  if (!check_team(scenario, out)) return;
  for (std::size_t i = 0; i < scenario.targets.size(); ++i)
    check_target_numbers(scenario.targets[i], "target " + std::to_string(i + 1), out);
  if (scenario.payload) check_payload_numbers(*scenario.payload, out);
}

void check_net(const Scenario& scenario, const StaticMap& map, Complaints& out) {
  if (!scenario.net) {
    if (!scenario.targets.empty() || scenario.payload || scenario.delivery)
      out.push_back("there are targets, a payload or a delivery, but no net");
    return;
  }
  if (scenario.payload && !scenario.targets.empty())
    out.push_back("there are both a payload and targets, expected one of them");
  if (!check_team(scenario, out)) return;
  const std::optional<Stand> goals = stand_at_goals(scenario);
  check_stand(scenario, map, stand_at_start(scenario), true, out);
  if (goals) check_stand(scenario, map, *goals, false, out);
  for (std::size_t i = 0; i < scenario.targets.size(); ++i)
    check_target(scenario, scenario.targets[i], "target " + std::to_string(i + 1), out);
  if (scenario.payload) check_payload(scenario, out);
  if (scenario.delivery) check_delivery(scenario, goals, out);
}

}  // namespace seine::world
