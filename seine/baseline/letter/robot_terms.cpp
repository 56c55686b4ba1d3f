#include "seine/baseline/letter/robot_terms.hpp"

#include <cmath>

#include "seine/baseline/letter/motion_limits.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

double squared(double x) {
  return x * x;
}

}  // namespace

RobotTerms::RobotTerms(const RobotTask& task, const Settings& settings)
    : task_(task),
      settings_(settings),
      penalties_(settings),
      curve_(task),
      shape_(task.model.footprint),
      max_curvature_(task.model.max_curvature()),
      inner_(settings.intervals),
      outer_(settings.end_intervals) {
  for (int s = 0; s < static_cast<int>(curve_.segments()); ++s)
    for (int j = 0; j < curve_.pieces(s); ++j) {
      const bool at_end = j == 0 || j + 1 == curve_.pieces(s);
      const int first = static_cast<int>(samples_.size());
      for (const Quadrature::Node& node : (at_end ? outer_ : inner_).nodes) {
        Sample sample;
        sample.place.segment = s, sample.place.piece = j;
        sample.node = &node;
        samples_.push_back(sample);
      }
      spans_.push_back({0.0, 0.0, {}, first, static_cast<int>(samples_.size()) - 1});
    }
}

void RobotTerms::evaluate(std::span<const double> x) {
  curve_.load(x);
  worst_ = {};
  place_samples();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    add_limits(samples_[i]);
    add_corridor(samples_[i], i);
  }
}

void RobotTerms::place_samples() {
  for (Sample& sample : samples_) {
    const int s = sample.place.segment, j = sample.place.piece;
    const double h = curve_.piece_duration(s);
    sample.place = curve_.place(s, j, *sample.node);
    sample.t = curve_.begin(s, j) + h * sample.node->w;
    sample.weight = h * sample.node->weight;
    sample.density = sample.g_time = 0.0;
    sample.g_position = sample.g_direction = sample.g_velocity = sample.g_acceleration = {};
  }
  for (Span& span : spans_) {
    const Place& place = samples_[static_cast<std::size_t>(span.first)].place;
    span.begin = samples_[static_cast<std::size_t>(span.first)].t;
    span.end = samples_[static_cast<std::size_t>(span.last)].t;
    span.box = curve_.hull(place.segment, place.piece);
  }
}

void RobotTerms::add_limits(Sample& sample) {
  const vehicle::Limits& limits = task_.model.limits;
  const Vec2 v = sample.place.velocity, a = sample.place.acceleration;
  const double v2 = geom::squared_norm(v), cross = geom::cross(v, a);
  const double top = curve_.gear(sample.place.segment) > 0 ? limits.speed : limits.reverse_speed;
  const auto add = [&](Limit limit, double violation, double relative, const FlatGradient& g) {
    double slope;
    sample.density += penalties_(limit, violation, slope);
    sample.g_velocity += slope * g.velocity;
    sample.g_acceleration += slope * g.acceleration;
    note(limit, relative);
  };
  // Most samples keep most limits: their gradients are worked out only where one is broken.
  FlatGradient g;
  if (v2 > top * top) {
    const double over = speed_limit(v, top, g);
    add(Limit::speed, over, std::sqrt(v2) / top - 1.0, g);
  }
  if (squared(geom::dot(v, a)) > v2 * squared(limits.acceleration)) {
    const double over = tangential_limit(v, a, limits.acceleration, g);
    add(Limit::tangential, over, std::abs(geom::dot(v, a)) / (std::sqrt(v2) * limits.acceleration) - 1.0, g);
  }
  if (squared(cross) > v2 * squared(limits.lateral_acceleration)) {
    const double over = lateral_limit(v, a, limits.lateral_acceleration, g);
    add(Limit::lateral, over, std::abs(cross) / (std::sqrt(v2) * limits.lateral_acceleration) - 1.0, g);
  }
  // κ ≤ κ_max and −κ ≤ κ_max are two limits; only one can be broken at a time.
  const double most = max_curvature_;
  if (std::abs(cross) > most * v2 * sample.place.speed) {
    const double over = curvature_limit(v, a, cross > 0.0 ? 1.0 : -1.0, most, g);
    add(Limit::curvature, over, over / most, g);
  }
}

// n·(σ + R(θ) c) − b ≤ 0 for every corner c and every half-plane of the sample's region.
void RobotTerms::add_corridor(Sample& sample, std::size_t region) {
  const corridor::Corridor& corridor = task_.corridor;
  const Vec2 d = sample.place.direction;
  for (int i = corridor.begin[region]; i < corridor.begin[region + 1]; ++i) {
    const auto plane = static_cast<std::size_t>(i);
    const Vec2 n{corridor.nx[plane], corridor.ny[plane]};
    const Vec2 in_body{geom::dot(d, n), geom::cross(d, n)};
    const double base = geom::dot(n, sample.place.position) - corridor.b[plane];
    for (const Vec2 corner : shape_.corners) {
      const double over = base + geom::dot(in_body, corner);
      if (over <= 0.0) continue;
      double slope;
      sample.density += penalties_(Limit::corridor, over, slope);
      sample.g_position += slope * n;
      sample.g_direction += slope * Vec2{geom::dot(corner, n), geom::cross(corner, n)};
      note(Limit::corridor, over - settings_.slack);
    }
  }
}

double RobotTerms::collect(CurveGradient& gradient) const {
  double cost = settings_.jerk_weight * curve_.jerk(settings_.jerk_weight, gradient);
  cost += settings_.time_weight * curve_.duration();
  for (int s = 0; s < static_cast<int>(curve_.segments()); ++s)
    gradient.durations[static_cast<std::size_t>(s)] += settings_.time_weight * curve_.pieces(s);
  for (const Sample& sample : samples_) {
    if (sample.density == 0.0) continue;
    const Place& place = sample.place;
    cost += sample.weight * sample.density;
    gradient.durations[static_cast<std::size_t>(place.segment)] += sample.node->weight * sample.density;
    const double gear = curve_.gear(place.segment);
    const Vec2 across = sample.g_direction - geom::dot(sample.g_direction, place.direction) * place.direction;
    const Vec2 g_velocity = sample.g_velocity + (gear / place.speed) * across;
    curve_.pull(place, *sample.node, sample.weight * sample.g_position, sample.weight * g_velocity,
                sample.weight * sample.g_acceleration, gradient);
    curve_.pull_time(place.segment, place.piece + place.w, sample.g_time, gradient);
  }
  return cost;
}

}  // namespace seine::baseline::letter
