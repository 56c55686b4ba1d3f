#include "seine/sim/catch_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "seine/geom/polygon.hpp"
#include "seine/sim/drift.hpp"

namespace seine::sim {
namespace {

using geom::Vec2;
using geom::Vec3;

constexpr double kTouchGrace = 0.02;  // s without touch that still count as rest: it trembles

bool in_triangle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const double u = geom::cross(b - a, p - a), v = geom::cross(c - b, p - b), w = geom::cross(a - c, p - c);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

// Whether the plumb line through `p` meets a face below it.
bool above_face(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
  if (!in_triangle(a.ground(), b.ground(), c.ground(), p.ground())) return false;
  const Vec3 normal = cross(b - a, c - a);
  return normal.z != 0.0 && a.z - dot(p - a, {normal.x, normal.y, 0.0}) / normal.z < p.z;
}

using Triangle = std::array<Vec3, 3>;

Vec3 normal_of(const Triangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

// Whether a point that went straight from p to q went through a triangle that went straight from s to t.
bool goes_through(Vec3 p, Vec3 q, const Triangle& s, const Triangle& t) {
  const double before = dot(p - s[0], normal_of(s)), after = dot(q - t[0], normal_of(t));
  if ((before > 0.0) == (after > 0.0)) return false;
  const double part = before / (before - after);
  const Vec3 at = p + part * (q - p);
  Triangle m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = s[i] + part * (t[i] - s[i]);
  const Vec3 normal = normal_of(m);
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(m[(i + 1) % 3] - m[i], at - m[i]), normal) < 0.0) return false;
  }
  return true;
}

Triangle triangle_of(std::span<const Vec3> nodes, const std::array<int, 3>& face) {
  return {nodes[static_cast<std::size_t>(face[0])], nodes[static_cast<std::size_t>(face[1])],
          nodes[static_cast<std::size_t>(face[2])]};
}

}  // namespace

const char* name_of(Fate fate) {
  constexpr std::array names{"flying", "inside", "caught", "restless", "miss",
                             "side",   "out",    "bottom", "leak"};
  return names[static_cast<std::size_t>(fate)];
}

void CatchWatch::look(double time, const NetPhysics& physics, std::span<const Vec3> corners) {
  const Ball& ball = physics.ball(ball_);
  std::vector<Vec2> polygon;
  for (const Vec3 corner : corners) polygon.push_back(corner.ground());
  const bool inside = geom::contains(polygon, ball.position.ground());
  touched_ = touched_ || physics.touching(ball_);
  if (started_ && !lost()) {
    lowest_ = std::min(lowest_, ball.position.z - ball.radius);
    if (touched_ && ball.velocity.z > 0.0) rebound_ = std::max(rebound_, ball.position.z);
    through_ = through_ || pierced(physics);
    time_rest(time - time_, physics, corners, inside);
    judge(time, physics, inside);
  }
  remember(time, physics, corners);
}

void CatchWatch::judge(double time, const NetPhysics& physics, bool inside) {
  const Ball& ball = physics.ball(ball_);
  const bool below = ball.position.z < rim_;
  if (fate_ == Fate::flying) {
    if (!below || place_.z < rim_) return;
    crossing_ = time;
    fate_ = Fate::inside;
  }
  if (ball.position.z <= ball.radius + 1e-6) {
    const bool in_net = inside && over_cloth(physics);
    fate_ = through_ ? Fate::leak : in_net ? Fate::bottom : touched_ ? Fate::side : Fate::miss;
  } else if (!inside) {
    fate_ = through_ ? Fate::leak : !below ? Fate::out : touched_ ? Fate::side : Fate::miss;
  } else if (fate_ == Fate::inside && at_rest()) {
    caught_ = time;
    fate_ = time - crossing_ <= kCatchTime ? Fate::caught : Fate::restless;
  } else if (fate_ == Fate::inside && time - crossing_ > kCatchTime) {
    fate_ = Fate::restless;
  }
}

void CatchWatch::time_rest(double step, const NetPhysics& physics, std::span<const Vec3> corners,
                           bool inside) {
  const Ball& ball = physics.ball(ball_);
  const Drift team = drift(corners_, corners, step);
  untouched_ = physics.touching(ball_) ? 0.0 : untouched_ + step;
  const bool slow = norm(ball.velocity - team.at(ball.position)) < kRestSpeed;
  rest_ = slow && inside && untouched_ <= kTouchGrace ? rest_ + step : 0.0;
}

bool CatchWatch::pierced(const NetPhysics& physics) const {
  const Vec3 now = physics.ball(ball_).position;
  const std::span<const Vec3> nodes = physics.nodes();
  const double reach = physics.ball(ball_).radius + 3.0 * physics.mesh().face_reach;
  for (const auto& face : physics.mesh().faces) {
    const Vec3 apart = now - nodes[static_cast<std::size_t>(face[0])];
    if (dot(apart, apart) > reach * reach) continue;
    if (goes_through(place_, now, triangle_of(nodes_, face), triangle_of(nodes, face))) return true;
  }
  return false;
}

bool CatchWatch::over_cloth(const NetPhysics& physics) const {
  const Vec3 now = physics.ball(ball_).position;
  return std::any_of(physics.mesh().faces.begin(), physics.mesh().faces.end(), [&](const auto& face) {
    const Triangle t = triangle_of(physics.nodes(), face);
    return above_face(t[0], t[1], t[2], now);
  });
}

void CatchWatch::remember(double time, const NetPhysics& physics, std::span<const Vec3> corners) {
  started_ = true;
  time_ = time;
  place_ = physics.ball(ball_).position;
  nodes_.assign(physics.nodes().begin(), physics.nodes().end());
  corners_.assign(corners.begin(), corners.end());
}

}  // namespace seine::sim
