#include "seine/sim/cloth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr double kPartingSpeed = 1.0;  // m/s
constexpr double kRollInertia = 0.4;   // of a solid ball: I = 0.4 m r²

using Face = std::array<int, 3>;

double along_side(Vec3 a, Vec3 b, Vec3 point) {
  const Vec3 side = b - a;
  const double length = dot(side, side);
  return length > 0.0 ? std::clamp(dot(point - a, side) / length, 0.0, 1.0) : 0.0;
}

// How the object touches a face: the point of the face, and from there towards the object's centre.
struct Touch {
  std::array<std::size_t, 3> nodes;
  std::array<double, 3> weights;
  Vec3 normal;
  double overlap;
  double cloth_mobility;  // Σ w_i² / m_i
};

bool find_touch(const Cloth& cloth, const Body& body, const Face& face, double face_reach, Touch& touch) {
  std::array<Vec3, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    touch.nodes[i] = static_cast<std::size_t>(face[i]);
    at[i] = cloth.position[touch.nodes[i]];
  }
  const double radius = body.ball.radius;
  const Vec3 off = body.ball.position - (1.0 / 3.0) * (at[0] + at[1] + at[2]);
  if (dot(off, off) > (radius + face_reach) * (radius + face_reach)) return false;
  touch.weights = nearest_weights(at, body.ball.position);
  const auto& w = touch.weights;
  const Vec3 apart = body.ball.position - (w[0] * at[0] + w[1] * at[1] + w[2] * at[2]);
  const double distance = norm(apart);
  if (distance >= radius || distance == 0.0) return false;
  touch.normal = (1.0 / distance) * apart;
  touch.overlap = radius - distance;
  touch.cloth_mobility = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    touch.cloth_mobility += w[i] * w[i] * cloth.inverse_mass[touch.nodes[i]];
  return true;
}

// An impulse times the step's length, kg m, on the object at the point of touch; the cloth takes the
// opposite.
void push(Cloth& cloth, Body& body, const Touch& touch, Vec3 amount) {
  body.ball.position += (1.0 / body.ball.mass) * amount;
  for (std::size_t i = 0; i < 3; ++i)
    cloth.position[touch.nodes[i]] += (-touch.weights[i] * cloth.inverse_mass[touch.nodes[i]]) * amount;
}

// How far the object's surface has slid over the cloth in this step.
Vec3 slip(const Cloth& cloth, const Body& body, const Touch& touch) {
  Vec3 moved = body.ball.position - body.before - body.ball.radius * cross(body.turn, touch.normal);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t v = touch.nodes[i];
    moved += (-touch.weights[i]) * (cloth.position[v] - cloth.before[v]);
  }
  return moved - dot(moved, touch.normal) * touch.normal;
}

void rub(Cloth& cloth, Body& body, const Touch& touch, double most) {
  const Vec3 slid = slip(cloth, body, touch);
  const double distance = norm(slid);
  if (distance < 1e-12) return;
  const double mobility = (1.0 + 1.0 / kRollInertia) / body.ball.mass + touch.cloth_mobility;
  const double amount = std::min(distance / mobility, most);
  const Vec3 against = (-amount / distance) * slid;
  push(cloth, body, touch, against);
  const double inertia = kRollInertia * body.ball.mass * body.ball.radius * body.ball.radius;
  body.turn += (-body.ball.radius / inertia) * cross(touch.normal, against);
}

}  // namespace

std::array<double, 3> nearest_weights(const std::array<Vec3, 3>& t, Vec3 point) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double area = dot(normal, normal);
  if (area > 0.0) {
    const double w0 = dot(cross(t[2] - t[1], point - t[1]), normal) / area;
    const double w1 = dot(cross(t[0] - t[2], point - t[2]), normal) / area;
    if (w0 >= 0.0 && w1 >= 0.0 && w0 + w1 <= 1.0) return {w0, w1, 1.0 - w0 - w1};
  }
  std::array<double, 3> best{};
  double nearest = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double s = along_side(t[i], t[j], point);
    const Vec3 apart = point - ((1.0 - s) * t[i] + s * t[j]);
    const double squared = dot(apart, apart);
    if (nearest >= 0.0 && squared >= nearest) continue;
    nearest = squared;
    best = {};
    best[i] = 1.0 - s;
    best[j] = s;
  }
  return best;
}

void press_apart(Cloth& cloth, Body& body, const Surface& surface, bool backwards) {
  Touch touch;
  const std::size_t count = surface.faces.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Face& face = surface.faces[backwards ? count - 1 - i : i];
    if (!find_touch(cloth, body, face, surface.face_reach, touch)) continue;
    const double amount = touch.overlap / (1.0 / body.ball.mass + touch.cloth_mobility);
    push(cloth, body, touch, amount * touch.normal);
    rub(cloth, body, touch, surface.friction * amount);
    body.touching = true;
  }
}

void press_apart(Body& a, Body& b, double h) {
  const Vec3 apart = b.ball.position - a.ball.position;
  const double distance = norm(apart), reach = a.ball.radius + b.ball.radius;
  if (distance >= reach) return;
  // What they came together in this step is a collision. Objects that were told to be in one place part
  // slowly, without getting any speed from it.
  const double overlap = reach - distance;
  const double met = std::clamp(norm(b.before - a.before) - distance, 0.0, overlap);
  const double parted = std::min(overlap - met, kPartingSpeed * h);
  const Vec3 normal = distance > 0.0 ? (1.0 / distance) * apart : Vec3{1.0, 0.0, 0.0};
  const double share = 1.0 / (a.ball.mass + b.ball.mass);
  for (const auto& [body, part] : {std::pair{&a, -share * b.ball.mass}, std::pair{&b, share * a.ball.mass}}) {
    body->ball.position += (part * (met + parted)) * normal;
    body->before += (part * parted) * normal;
  }
}

void keep_above_ground(Body& body) {
  if (body.ball.position.z >= body.ball.radius) return;
  body.ball.position = {body.before.x, body.before.y, body.ball.radius};
  body.turn = {};
}

}  // namespace seine::sim
