#include "seine/net/flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace seine::net {
namespace {

using geom::Vec3;

// A step keeps drag |v| h below this, so that one classical Runge-Kutta step errs by less than 1e-9 m.
constexpr double kStiffness = 0.02;
constexpr double kLongestStep = 0.02;        // s
constexpr double kLongestFlight = 100.0;     // s that are tabulated
constexpr std::size_t kMostNodes = 200'000;  // a feather in syrup is not followed to the ground
constexpr double kLeastFall = 1e-6;          // m/s: slower than this it only touches a height

Vec3 acceleration(double drag, Vec3 v) {
  return Vec3{0.0, 0.0, -kGravity} + (-drag * norm(v)) * v;
}

// One classical Runge-Kutta step of the flight with drag.
FlightState step(double drag, const FlightState& from, double h) {
  const Vec3 v1 = from.velocity;
  const Vec3 a1 = acceleration(drag, v1);
  const Vec3 v2 = v1 + (0.5 * h) * a1;
  const Vec3 a2 = acceleration(drag, v2);
  const Vec3 v3 = v1 + (0.5 * h) * a2;
  const Vec3 a3 = acceleration(drag, v3);
  const Vec3 v4 = v1 + h * a3;
  const Vec3 a4 = acceleration(drag, v4);
  return {from.time + h, from.position + (h / 6.0) * (v1 + 2.0 * v2 + 2.0 * v3 + v4),
          v1 + (h / 6.0) * (a1 + 2.0 * a2 + 2.0 * a3 + a4)};
}

double step_length(double drag, const FlightState& from) {
  // Until the step is over gravity may add some speed.
  return std::min(kLongestStep, kStiffness / (drag * (norm(from.velocity) + kGravity * kLongestStep)));
}

FlightState fall(const Target& target, double t) {
  const double s = t - target.time;
  const Vec3 g{0.0, 0.0, -kGravity};
  return {t, target.position + s * target.velocity + (0.5 * s * s) * g, target.velocity + s * g};
}

using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr Matrix3 kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// ∂a/∂v applied to every column of m: a = −drag |v| v, so ∂a/∂v = −drag (|v| I + v vᵀ / |v|).
Matrix3 damped(double drag, Vec3 v, const Matrix3& m) {
  const double speed = norm(v);
  const std::array<double, 3> along{v.x, v.y, v.z};
  Matrix3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double pull = speed > 0.0 ? (v.x * m[0][c] + v.y * m[1][c] + v.z * m[2][c]) / speed : 0.0;
    for (std::size_t r = 0; r < 3; ++r) out[r][c] = -drag * (speed * m[r][c] + pull * along[r]);
  }
  return out;
}

Matrix3 sum(const Matrix3& a, double s, const Matrix3& b) {
  Matrix3 out = a;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out[r][c] += s * b[r][c];
  return out;
}

// How an error of the velocity at release has become one of position and of velocity.
struct Spread {
  Matrix3 position{};
  Matrix3 velocity = kIdentity;
};

// Carries `spread` over one step by the linearised equation of motion; Runge-Kutta with the flight's own
// states.
void carry(Spread& spread, double drag, const FlightState& from, double h) {
  const Vec3 middle = step(drag, from, 0.5 * h).velocity;
  const Vec3 end = step(drag, from, h).velocity;
  const Matrix3& m1 = spread.velocity;
  const Matrix3 k1 = damped(drag, from.velocity, m1);
  const Matrix3 m2 = sum(m1, 0.5 * h, k1);
  const Matrix3 k2 = damped(drag, middle, m2);
  const Matrix3 m3 = sum(m1, 0.5 * h, k2);
  const Matrix3 k3 = damped(drag, middle, m3);
  const Matrix3 m4 = sum(m1, h, k3);
  const Matrix3 k4 = damped(drag, end, m4);
  Matrix3 position = spread.position;
  position = sum(sum(sum(sum(position, h / 6.0, m1), h / 3.0, m2), h / 3.0, m3), h / 6.0, m4);
  const Matrix3 velocity = sum(sum(sum(sum(m1, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
  spread = {position, velocity};
}

Spread spread_at(const Target& target, const std::vector<FlightState>& nodes, double t) {
  Spread spread;
  if (target.drag == 0.0) {
    spread.position = sum(Matrix3{}, t - target.time, kIdentity);
    return spread;
  }
  for (std::size_t i = 0; i < nodes.size() && nodes[i].time < t; ++i) {
    const double until = i + 1 < nodes.size() ? std::min(nodes[i + 1].time, t) : t;
    carry(spread, target.drag, nodes[i], until - nodes[i].time);
  }
  return spread;
}

// The covariance of where the target passes a height: J P Jᵀ, J the derivative of that place by the first
// state.
std::array<double, 3> passing_covariance(const Target& target, const Spread& spread, Vec3 velocity) {
  std::array<std::array<double, 6>, 2> jacobian{};
  const std::array<double, 2> slope{-velocity.x / velocity.z, -velocity.y / velocity.z};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    jacobian[axis][axis] = 1.0;
    jacobian[axis][2] = slope[axis];
    for (std::size_t c = 0; c < 3; ++c)
      jacobian[axis][3 + c] = spread.position[axis][c] + slope[axis] * spread.position[2][c];
  }
  const auto product = [&](std::size_t a, std::size_t b) {
    double total = 0.0;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) total += jacobian[a][i] * target.covariance[i][j] * jacobian[b][j];
    return total;
  };
  return {product(0, 0), product(0, 1), product(1, 1)};
}

double larger_half_axis(const std::array<double, 3>& c) {
  const double mean = 0.5 * (c[0] + c[2]);
  return std::sqrt(std::max(0.0, mean + std::hypot(0.5 * (c[0] - c[2]), c[1])));
}

}  // namespace

Flight::Flight(const Target& target) : target_(target) {
  if (target_.drag > 0.0) tabulate();
}

void Flight::tabulate() {
  nodes_.push_back({target_.time, target_.position, target_.velocity});
  const double end = target_.time + kLongestFlight;
  while (nodes_.size() < kMostNodes && nodes_.back().time < end) {
    const FlightState& last = nodes_.back();
    if (last.position.z < 0.0 && last.velocity.z < 0.0) break;
    nodes_.push_back(step(target_.drag, last, step_length(target_.drag, last)));
  }
}

std::size_t Flight::node_before(double t) const {
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), t,
                                      [](double time, const FlightState& node) { return time < node.time; });
  return after == nodes_.begin() ? 0 : static_cast<std::size_t>(after - nodes_.begin()) - 1;
}

FlightState Flight::at(double t) const {
  if (t <= target_.time) return {t, target_.position, target_.velocity};
  if (nodes_.empty()) return fall(target_, t);
  FlightState state = nodes_[node_before(t)];
  while (state.time < t) {
    const double h = step_length(target_.drag, state);
    if (state.time + h >= t) {
      state = step(target_.drag, state, t - state.time);
      state.time = t;
      break;
    }
    state = step(target_.drag, state, h);
  }
  return state;
}

std::optional<double> Flight::falling_time(double height) const {
  if (nodes_.empty()) {
    const double rise = target_.velocity.z;
    const double drop = target_.position.z - height;
    const double square = rise * rise + 2.0 * kGravity * drop;
    if (square < 0.0) return std::nullopt;
    const double s = (rise + std::sqrt(square)) / kGravity;
    return s >= 0.0 ? std::optional(target_.time + s) : std::nullopt;
  }
  // Once it falls it goes on falling: the last node above the height is followed by the one crossing.
  std::size_t above = nodes_.size();
  while (above > 0 && nodes_[above - 1].position.z < height) --above;
  if (above == 0) return std::nullopt;
  if (above == nodes_.size()) return std::nullopt;  // still above when the table ends
  double low = nodes_[above - 1].time;
  double high = nodes_[above].time;
  for (int i = 0; i < 60 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle).position.z >= height ? low : high) = middle;
  }
  return low;
}

std::optional<Crossing> Flight::crossing(double height) const {
  const std::optional<double> time = falling_time(height);
  if (!time) return std::nullopt;
  Crossing crossing{at(*time)};
  if (crossing.state.velocity.z > -kLeastFall) return std::nullopt;
  const Spread spread = spread_at(target_, nodes_, *time);
  crossing.covariance = passing_covariance(target_, spread, crossing.state.velocity);
  crossing.error = kErrorSigmas * larger_half_axis(crossing.covariance);
  return crossing;
}

}  // namespace seine::net
