#include "seine/sim/flight_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "seine/net/flight.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

constexpr double kStep = 0.01;         // s, longest step of a prediction
constexpr double kLongestFall = 10.0;  // s looked ahead
constexpr double kStiffness = 0.25;    // drag · speed · step, at most, of a short step …
constexpr double kMostParts = 200.0;   // … of which a step has no more than this
constexpr double kWalk = 1e-6;  // m²/s³ and m²/s⁵: velocity and push may drift, so the filter stays awake

// Where the parts of the state begin.
constexpr std::size_t kVelocity = 3, kDrag = 6, kPush = 7;

std::array<double, 3> axes_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

struct Motion {
  Vec3 position, velocity;
};

Vec3 acceleration(Vec3 velocity, double drag, Vec3 push) {
  return push + Vec3{0.0, 0.0, -net::kGravity} + (-drag * norm(velocity)) * velocity;
}

// One short step, with the acceleration of its middle.
Motion short_step(const Motion& from, double drag, Vec3 push, double h) {
  const Vec3 middle = from.velocity + (0.5 * h) * acceleration(from.velocity, drag, push);
  const Vec3 a = acceleration(middle, drag, push);
  return {from.position + h * from.velocity + (0.5 * h * h) * a, from.velocity + h * a};
}

// A step in as many short ones as strong drag needs.
Motion step(Motion motion, double drag, Vec3 push, double h) {
  const double stiff = std::min(drag * norm(motion.velocity) * h / kStiffness, kMostParts);
  const int parts = std::max(1, static_cast<int>(std::ceil(stiff)));
  for (int i = 0; i < parts; ++i) motion = short_step(motion, drag, push, h / parts);
  return motion;
}

int steps_of(double duration) {
  return std::max(1, static_cast<int>(std::ceil(duration / kStep)));
}

Motion fly(Motion motion, double drag, Vec3 push, double duration) {
  const int steps = steps_of(duration);
  for (int i = 0; i < steps; ++i) motion = step(motion, drag, push, duration / steps);
  return motion;
}

double square(double x) {
  return x * x;
}

// dᵀ S⁻¹ d for a symmetric positive definite S, by Cramer's rule.
double distance_in(const SmallMatrix<3, 3>& s, Vec3 d) {
  const Vec3 a{s[0][0], s[0][1], s[0][2]}, b{s[1][0], s[1][1], s[1][2]}, c{s[2][0], s[2][1], s[2][2]};
  const Vec3 solved{dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
  return dot(d, solved) / dot(a, cross(b, c));
}

}  // namespace

void FlightFilter::start(double time, Vec3 position) {
  started_ = true;
  time_ = time;
  outliers_ = 0;
  state_ = {position.x, position.y, position.z, 0.0, 0.0, 0.0, options_.drag, 0.0, 0.0, 0.0};
  covariance_ = {};
  for (std::size_t i = 0; i < 3; ++i) {
    covariance_[i][i] = square(options_.noise);
    covariance_[kVelocity + i][kVelocity + i] = square(options_.speed_error);
    covariance_[kPush + i][kPush + i] = square(options_.push_error);
  }
  covariance_[kDrag][kDrag] = square(options_.drag_error);
}

void FlightFilter::expect(const net::Target& told) {
  start(told.time, told.position);
  for (std::size_t i = 0; i < 3; ++i) state_[kVelocity + i] = axes_of(told.velocity)[i];
  state_[kDrag] = told.drag;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) covariance_[i][j] = told.covariance[i][j];
}

bool FlightFilter::observe(double time, Vec3 position) {
  if (!started_) {
    start(time, position);
    return true;
  }
  assert(time >= time_);
  if (time > time_) predict(time - time_);
  if (surprise(position) > options_.gate) {
    if (++outliers_ < options_.patience) return false;
    doubt(position);
  }
  outliers_ = 0;
  correct(position);
  return true;
}

void FlightFilter::predict(double duration) {
  const int steps = steps_of(duration);
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    covariance_ = carried(transition(h), covariance_);
    const Motion next = step({this->position(), this->velocity()}, drag(), push(), h);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state_[axis] = axes_of(next.position)[axis];
      state_[kVelocity + axis] = axes_of(next.velocity)[axis];
      covariance_[kVelocity + axis][kVelocity + axis] += kWalk * h;
      covariance_[kPush + axis][kPush + axis] += kWalk * h;
    }
  }
  time_ += duration;
}

// I + h A + ½ h² A², A the derivative of the state's rate of change. Only accelerations depend on the state
// in other than trivial ways: their rows are α.
FlightFilter::Matrix FlightFilter::transition(double h) const {
  const std::array<double, 3> v = axes_of(velocity());
  const double speed = norm(velocity());
  SmallMatrix<3, kSize> alpha{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      alpha[i][kVelocity + j] =
          -drag() * ((i == j ? speed : 0.0) + (speed > 0.0 ? v[i] * v[j] / speed : 0.0));
    alpha[i][kDrag] = -speed * v[i];
    alpha[i][kPush + i] = 1.0;
  }
  Matrix f = identity<kSize>();
  for (std::size_t i = 0; i < 3; ++i) {
    f[i][kVelocity + i] += h;
    for (std::size_t j = kVelocity; j < kSize; ++j) {
      f[i][j] += 0.5 * h * h * alpha[i][j];
      f[kVelocity + i][j] += h * alpha[i][j];
      for (std::size_t l = 0; l < 3; ++l)
        f[kVelocity + i][j] += 0.5 * h * h * alpha[i][kVelocity + l] * alpha[l][j];
    }
  }
  return f;
}

double FlightFilter::surprise(Vec3 seen) const {
  SmallMatrix<3, 3> s{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) s[i][j] = covariance_[i][j];
    s[i][i] += square(options_.noise);
  }
  return distance_in(s, seen - position());
}

// Errors along the three axes are independent, so they may be taken one after the other.
void FlightFilter::correct(Vec3 seen) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const State row = covariance_[axis];
    const double variance = row[axis] + square(options_.noise);
    const double off = axes_of(seen)[axis] - state_[axis];
    for (std::size_t i = 0; i < kSize; ++i) {
      state_[i] += row[i] / variance * off;
      for (std::size_t j = 0; j < kSize; ++j) covariance_[i][j] -= row[i] * row[j] / variance;
    }
  }
  state_[kDrag] = std::max(0.0, state_[kDrag]);
}

// The place may be off by as much as what was seen last, the velocity by anything; drag and push are kept.
void FlightFilter::doubt(Vec3 seen) {
  const Vec3 off = seen - position();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) {
      covariance_[i][j] = covariance_[j][i] = 0.0;
      covariance_[kVelocity + i][j] = covariance_[j][kVelocity + i] = 0.0;
    }
    covariance_[i][i] = dot(off, off);
    covariance_[kVelocity + i][kVelocity + i] = square(options_.speed_error);
  }
}

Vec3 FlightFilter::position_at(double time) const {
  assert(time >= time_);
  return fly({position(), velocity()}, drag(), push(), time - time_).position;
}

double FlightFilter::time_to_fall(double height) const {
  Motion motion{position(), velocity()};
  double time = 0.0;
  while (time < kLongestFall && (motion.position.z > height || motion.velocity.z > 0.0)) {
    const Motion next = step(motion, drag(), push(), kStep);
    if (next.position.z <= height && next.velocity.z <= 0.0) {
      const double drop = motion.position.z - next.position.z;
      return time + (drop > 0.0 ? kStep * std::max(0.0, motion.position.z - height) / drop : 0.0);
    }
    motion = next;
    time += kStep;
  }
  return time;
}

std::optional<net::Target> FlightFilter::target(const net::Target& like, double rim) const {
  if (!started_) return std::nullopt;
  net::Target target = like;
  target.time = time_;
  target.position = position();
  target.velocity = velocity();
  target.drag = drag();
  const double fall = time_to_fall(rim);
  // Velocity is changed until the flight without push arrives where the one with push does.
  if (fall > 0.0) {
    const Vec3 goal = position_at(time_ + fall);
    for (int i = 0; i < 3; ++i) {
      const Vec3 there = fly({target.position, target.velocity}, drag(), {}, fall).position;
      target.velocity += (1.0 / fall) * (goal - there);
    }
  }
  // An error δ of the acceleration moves the place after `fall` as ½ fall δ of the velocity does.
  SmallMatrix<6, kSize> seen{};
  const std::array<double, 3> pull = axes_of(norm(velocity()) * velocity());
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i][i] = seen[kVelocity + i][kVelocity + i] = 1.0;
    seen[kVelocity + i][kPush + i] = 0.5 * fall;
    seen[kVelocity + i][kDrag] = -0.5 * fall * pull[i];
  }
  target.covariance = carried(seen, covariance_);
  return target;
}

}  // namespace seine::sim
