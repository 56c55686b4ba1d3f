#include "seine/sim/localisation.hpp"

#include <cmath>

#include "seine/vehicle/arc.hpp"

namespace seine::sim {
namespace {

constexpr double kMemory = 1.0;       // s, of the errors of fixes
constexpr double kLongMemory = 10.0;  // s, of those of the wheels: calibration
constexpr double kTrust = 0.3;        // of the difference to a fix that is taken over at once

}  // namespace

Localisation::Localisation(const vehicle::Model& model, const Noise& noise, const CarState& start,
                           std::uint64_t seed)
    : model_(model),
      noise_(noise),
      rng_(seed),
      belief_(start),
      x_(noise.position, kMemory, rng_),
      y_(noise.position, kMemory, rng_),
      heading_(noise.heading, kMemory, rng_),
      speed_scale_(noise.odometry, kLongMemory, rng_),
      steering_offset_(noise.odometry, kLongMemory, rng_) {}

void Localisation::look(const CarState& truth, bool fix_available) {
  for (DriftingError* error : {&x_, &y_, &heading_, &speed_scale_, &steering_offset_})
    error->advance(kOdometryPeriod, rng_);
  roll(truth);
  since_fix_ += kOdometryPeriod;
  if (++ticks_ % kFixEvery == 0 && fix_available) fix(truth);
}

void Localisation::roll(const CarState& truth) {
  const double before = belief_.speed, wheel = belief_.steering;
  belief_.speed = (1.0 + speed_scale_.value()) * truth.speed;
  belief_.steering = truth.steering + steering_offset_.value();
  belief_.acceleration = truth.acceleration;
  const double curvature = std::tan(0.5 * (wheel + belief_.steering)) / model_.wheelbase;
  belief_.pose = vehicle::drive(belief_.pose, curvature, 0.5 * (before + belief_.speed) * kOdometryPeriod);
}

void Localisation::fix(const CarState& truth) {
  since_fix_ = 0.0;
  const double trust = noise_.position > 0.0 ? kTrust : 1.0;
  geom::Pose2& pose = belief_.pose;
  pose.x += trust * (truth.pose.x + x_.value() - pose.x);
  pose.y += trust * (truth.pose.y + y_.value() - pose.y);
  const double turn = geom::wrap_angle(truth.pose.heading + heading_.value() - pose.heading);
  pose.heading = geom::wrap_angle(pose.heading + trust * turn);
}

}  // namespace seine::sim
