#include "seine/sim/cord_net.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/sim/drift.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr double kSettling = 1.5;         // s that the empty net swings out before the scene begins
constexpr double kSettlingAir = 8.0;      // 1/s, meanwhile
constexpr double kStepsPerRadius = 60.0;  // s/m: at 12 m/s a ball moves a fifth of its radius in one step
constexpr double kStretchedFace = 1.3;    // faces are taken for so much larger than they are at rest
constexpr double kShortestStep = 1e-4;    // s

Vec3 acceleration(const Ball& ball, Vec3 velocity) {
  return Vec3{0.0, 0.0, -net::kGravity} + (-ball.drag * norm(velocity)) * velocity;
}

// Strong drag is integrated in parts of the step.
constexpr double kStiffness = 0.1;  // drag · speed · part, at most …
constexpr double kMostParts = 100;  // … but no more parts than this

// One step of free flight. By the acceleration in the middle of a part it is exact but for its drag's third
// order. Leaves in `velocity` what `finish` adds to the mean velocity of the step.
void fly(Ball& ball, double h) {
  const double stiff = std::min(ball.drag * norm(ball.velocity) * h / kStiffness, kMostParts);
  const int parts = std::max(1, static_cast<int>(std::ceil(stiff)));
  const double part = h / parts;
  const Vec3 start = ball.position;
  for (int i = 0; i < parts; ++i) {
    const Vec3 a = acceleration(ball, ball.velocity + (0.5 * part) * acceleration(ball, ball.velocity));
    ball.position += part * ball.velocity + (0.5 * part * part) * a;
    if (parts == 1)
      ball.velocity = (0.5 * h) * a;
    else
      ball.velocity += part * a;
  }
  if (parts > 1) ball.velocity = ball.velocity - (1.0 / h) * (ball.position - start);
}

}  // namespace

CordNet::CordNet(const net::Net& net, std::span<const Vec3> corners, const NetMaterial& material)
    : mesh_(triangulate(net.rest)), material_(material), longest_step_(material.step) {
  assert(corners.size() == net.size());
  std::vector<geom::Vec2> ground;
  for (const Vec3 corner : corners) ground.push_back(corner.ground());
  cloth_.position = drape(mesh_, corners, net::empty_depth(net, ground));
  cloth_.before = cloth_.position;
  cloth_.velocity.assign(cloth_.position.size(), {});
  for (std::size_t v = 0; v < mesh_.share.size(); ++v)
    cloth_.inverse_mass.push_back(v < mesh_.corners ? 0.0 : 1.0 / (material.mass * mesh_.share[v]));
  pulls_.assign(mesh_.corners, {});
  impulses_.assign(mesh_.corners, {});
  taut_.resize(mesh_.flat.size());
  settle();
}

void CordNet::settle() {
  const std::vector<Vec3> corners(cloth_.position.begin(),
                                  cloth_.position.begin() + static_cast<std::ptrdiff_t>(mesh_.corners));
  const double air = std::exchange(material_.air, kSettlingAir);
  advance(corners, kSettling);
  material_.air = air;
}

std::size_t CordNet::add(const Ball& ball) {
  assert(ball.radius > 0.0 && ball.mass > 0.0);
  bodies_.push_back({ball, ball.position, {}, false});
  longest_step_ = std::max(kShortestStep, std::min(longest_step_, ball.radius / kStepsPerRadius));
  return bodies_.size() - 1;
}

void CordNet::advance(std::span<const Vec3> corners, double duration) {
  assert(corners.size() == mesh_.corners && duration > 0.0);
  start_.assign(cloth_.position.begin(),
                cloth_.position.begin() + static_cast<std::ptrdiff_t>(mesh_.corners));
  impulses_.assign(mesh_.corners, {});
  const int steps = std::max(1, static_cast<int>(std::ceil(duration / longest_step_ - 1e-6)));
  for (int i = 1; i <= steps; ++i) step(corners, static_cast<double>(i) / steps, duration / steps);
  for (std::size_t k = 0; k < mesh_.corners; ++k) pulls_[k] = (1.0 / duration) * impulses_[k];
}

void CordNet::step(std::span<const Vec3> corners, double part, double h) {
  predict(h);
  for (std::size_t k = 0; k < mesh_.corners; ++k)
    cloth_.position[k] = start_[k] + part * (corners[k] - start_[k]);
  tighten(h);
  press(h);
  finish(h);
  backwards_ = !backwards_;
}

void CordNet::predict(double h) {
  const Vec3 fall{0.0, 0.0, -net::kGravity * h * h};
  std::swap(cloth_.before, cloth_.position);
  for (std::size_t v = mesh_.corners; v < cloth_.position.size(); ++v)
    cloth_.position[v] = cloth_.before[v] + h * cloth_.velocity[v] + fall;
  for (Body& body : bodies_) {
    Ball& ball = body.ball;
    body.before = ball.position;
    fly(ball, h);
    body.turn = h * ball.spin;
    body.touching = false;
  }
}

void CordNet::tighten(double h) {
  const auto pull = [&](const Cord& cord) {
    tighten(static_cast<std::size_t>(cord.a), static_cast<std::size_t>(cord.b), cord.rest, h);
  };
  if (backwards_) {
    std::for_each(mesh_.cords.rbegin(), mesh_.cords.rend(), pull);
  } else {
    std::for_each(mesh_.cords.begin(), mesh_.cords.end(), pull);
  }
  for (std::size_t k = 0; k < mesh_.corners; ++k)
    tighten_geodesics(backwards_ ? mesh_.corners - 1 - k : k, h);
}

void CordNet::tighten(std::size_t a, std::size_t b, double rest, double h) {
  const Vec3 across = cloth_.position[b] - cloth_.position[a];
  const double squared = dot(across, across), allowed = rest * rest;
  if (squared <= allowed) return;
  const double w_a = cloth_.inverse_mass[a], w_b = cloth_.inverse_mass[b];
  const double give = rest / (material_.stiffness * h * h);  // 1/kg: how little a soft cord corrects
  // (length − rest) / length with one Newton step for the root: 1.2 % too much at 2.5 % of stretch.
  const double excess = (squared - allowed) / (squared + allowed);
  const Vec3 amount = (excess / (w_a + w_b + give)) * across;  // kg m
  cloth_.position[a] += w_a * amount;
  cloth_.position[b] += (-w_b) * amount;
  if (a < mesh_.corners) impulses_[a] += (1.0 / h) * amount;
}

void CordNet::tighten_geodesics(std::size_t corner, double h) {
  // The corner is not moved by this, so no node depends on another: those in question are found first.
  const std::size_t nodes = cloth_.position.size();
  const double* rest = &mesh_.geodesics[corner * nodes];
  const Vec3 at = cloth_.position[corner];
  std::size_t count = 0;
  for (std::size_t v = mesh_.corners; v < nodes; ++v) {
    const Vec3 across = cloth_.position[v] - at;
    taut_[count] = v;
    count += dot(across, across) > rest[v] * rest[v] ? 1 : 0;
  }
  for (std::size_t i = 0; i < count; ++i) tighten(corner, taut_[i], rest[taut_[i]], h);
}

void CordNet::press(double h) {
  const Surface surface{mesh_.faces, kStretchedFace * mesh_.face_reach, material_.friction};
  double highest = 0.0;
  for (std::size_t k = 0; k < mesh_.corners; ++k) highest = std::max(highest, cloth_.position[k].z);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    for (std::size_t j = 0; j < i; ++j) press_apart(bodies_[j], body, h);
    if (body.ball.position.z - body.ball.radius < highest + 0.2)
      press_apart(cloth_, body, surface, backwards_);
    keep_above_ground(body);
  }
  for (std::size_t v = mesh_.corners; v < cloth_.position.size(); ++v)
    cloth_.position[v].z = std::max(cloth_.position[v].z, 0.0);
}

void CordNet::finish(double h) {
  const Drift team = drift(std::span(cloth_.before).first(mesh_.corners),
                           std::span(cloth_.position).first(mesh_.corners), h);
  const double kept = std::exp(-material_.air * h), held = std::exp(-material_.holding * h);
  for (std::size_t v = mesh_.corners; v < cloth_.position.size(); ++v) {
    const Vec3 still = team.at(cloth_.position[v]);
    const Vec3 velocity = (1.0 / h) * (cloth_.position[v] - cloth_.before[v]);
    cloth_.velocity[v] = still + kept * (velocity - still);
  }
  for (Body& body : bodies_) {
    Ball& ball = body.ball;
    ball.velocity += (1.0 / h) * (ball.position - body.before);
    ball.spin = (1.0 / h) * body.turn;
    if (!body.touching) continue;
    const Vec3 lost = (1.0 - held) * (ball.velocity - team.at(ball.position));
    ball.velocity = ball.velocity - lost;
    ball.spin = held * ball.spin;
    for (Vec3& impulse : impulses_) impulse += (ball.mass / static_cast<double>(mesh_.corners)) * lost;
  }
}

}  // namespace seine::sim
