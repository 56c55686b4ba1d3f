#include "seine/sim/thrown.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "seine/base/rng.hpp"
#include "seine/net/flight.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

// A throw that was announced has its drag known; a little doubt keeps the filter able to learn.
constexpr double kDragDoubt = 1e-3;        // 1/m
constexpr double kPushDoubt = 0.02;        // m/s²
constexpr double kLeastSightError = 1e-3;  // m, that the filter takes for granted
constexpr double kLeastThrowError = 1e-3;  // m and m/s

using Matrix = SmallMatrix<6, 6>;

// The lower triangular root of a positive semidefinite matrix (Cholesky; rows of no variance stay zero).
Matrix root_of(const Matrix& covariance) {
  Matrix root{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = covariance[i][j];
      for (std::size_t l = 0; l < j; ++l) rest -= root[i][l] * root[j][l];
      root[i][j] = i == j ? std::sqrt(std::max(0.0, rest)) : root[j][j] > 0.0 ? rest / root[j][j] : 0.0;
    }
  }
  return root;
}

Matrix total_covariance(const net::Target& told, const Noise& noise, double least) {
  Matrix total = told.covariance;
  for (std::size_t i = 0; i < 6; ++i) {
    const double more = std::max(least, i < 3 ? noise.throw_position : noise.throw_velocity);
    total[i][i] += more * more;
  }
  return total;
}

net::Target draw(const net::Target& told, const Noise& noise, Rng& rng) {
  const Matrix root = root_of(total_covariance(told, noise, 0.0));
  std::array<double, 6> normal{}, off{};
  for (double& value : normal) value = rng.normal();
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) off[i] += root[i][j] * normal[j];
  net::Target truth = told;
  truth.position += Vec3{off[0], off[1], off[2]};
  truth.velocity += Vec3{off[3], off[4], off[5]};
  truth.covariance = {};
  return truth;
}

}  // namespace

Thrown::Thrown(const net::Target& told, double rim, const Noise& noise, std::uint64_t seed)
    : told_(told),
      truth_(told),
      rim_(rim),
      sensor_(noise, seed),
      filter_({.noise = std::max(noise.sight, kLeastSightError),
               .drag_error = kDragDoubt,
               .push_error = kPushDoubt}) {
  Rng rng(~seed);
  truth_ = draw(told, noise, rng);
  told_.covariance = total_covariance(told, noise, 0.0);
  net::Target expected = told_;
  expected.covariance = total_covariance(told, noise, kLeastThrowError);
  filter_.expect(expected);
}

void Thrown::look(double time, NetPhysics& physics, Vec3 shift) {
  if (!watch_ && time >= truth_.time) {
    const net::FlightState now = net::Flight(truth_).at(time);
    ball_ = physics.add({.position = now.position,
                         .velocity = now.velocity,
                         .radius = truth_.radius,
                         .mass = truth_.mass,
                         .drag = truth_.drag});
    watch_.emplace(ball_, rim_);
  }
  if (!watch_ || physics.touching(ball_) || !in_the_air()) return;
  sensor_.look(time, physics.ball(ball_).position, shift);
  while (const auto sight = sensor_.delivered(time)) {
    filter_.observe(sight->time, sight->position);
    seen_ = sight->position;
  }
}

void Thrown::watch(double time, const NetPhysics& physics, std::span<const Vec3> corners) {
  if (watch_) watch_->look(time, physics, corners);
}

net::Target Thrown::estimate() const {
  return filter_.time() > told_.time ? filter_.target(told_, rim_).value_or(told_) : told_;
}

TargetRecord Thrown::record(const NetPhysics& physics) {
  TargetRecord record;
  record.fate = fate();
  record.present = watch_.has_value();
  record.seen = seen_;
  seen_.reset();
  record.ball = {.position = truth_.position, .radius = truth_.radius, .mass = truth_.mass};
  if (!record.present) return record;
  record.ball = physics.ball(ball_);
  record.touching = physics.touching(ball_);
  if (in_the_air()) record.estimate = estimate();
  return record;
}

}  // namespace seine::sim
