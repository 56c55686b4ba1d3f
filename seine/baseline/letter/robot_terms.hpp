#pragma once

#include <array>
#include <span>
#include <vector>

#include "seine/baseline/letter/robot_curve.hpp"
#include "seine/baseline/letter/settings.hpp"
#include "seine/baseline/letter/smooth_distance.hpp"
#include "seine/math/hinge.hpp"

namespace seine::baseline::letter {

/// The largest violation met of each limit, 0 where there is none: relative to the limit for speed,
/// acceleration and curvature, metres for the others.
using Worst = std::array<double, kLimits>;

/// w_d L1(·) of each limit.
class Penalties {
 public:
  explicit Penalties(const Settings& settings) : weight_(settings.weight), knee_(settings.knee) {}
  double operator()(Limit limit, double violation, double& slope) const {
    const double w = weight_[static_cast<std::size_t>(limit)];
    const double value = w * math::hinge(violation, knee_, slope);
    slope *= w;
    return value;
  }

 private:
  std::array<double, kLimits> weight_;
  math::Knee knee_;
};

/// A node of the quadrature along a robot's own trajectory, and what the limits there ask. The penalty's
/// density is per second; `gradient` of it unless said otherwise.
struct Sample {
  Place place;
  const Quadrature::Node* node = nullptr;
  double t = 0.0;       ///< s, common clock
  double weight = 0.0;  ///< s, of the quadrature
  double density = 0.0;
  geom::Vec2 g_position, g_direction, g_velocity, g_acceleration;
  double g_time = 0.0;  ///< of the penalty (weight included) by t, where it depends on the clock
};

/// When a piece is driven and where.
struct Span {
  double begin, end;  ///< s
  geom::Box box;      ///< of the positions
  int first, last;    ///< samples, inclusive
};

/// One robot: its curve, its samples, the limits it has to keep by itself.
class RobotTerms {
 public:
  /// @param task must outlive the terms
  RobotTerms(const RobotTask& task, const Settings& settings);
  RobotTerms(const RobotTerms&) = delete;  // samples point into the quadratures
  RobotTerms(RobotTerms&&) = default;

  const RobotCurve& curve() const { return curve_; }
  RobotCurve& curve() { return curve_; }
  const Shape& shape() const { return shape_; }
  std::vector<Sample>& samples() { return samples_; }
  const std::vector<Span>& spans() const { return spans_; }
  const Worst& worst() const { return worst_; }

  /// Curve and samples at these variables, the robot's own limits at the samples.
  void evaluate(std::span<const double> x);
  /// Effort, time and the penalties of all samples; adds their gradient.
  double collect(CurveGradient& gradient) const;

 private:
  void place_samples();
  void add_limits(Sample& sample);
  void add_corridor(Sample& sample, std::size_t region);
  void note(Limit limit, double violation) {
    double& worst = worst_[static_cast<std::size_t>(limit)];
    worst = violation > worst ? violation : worst;
  }

  const RobotTask& task_;
  Settings settings_;
  Penalties penalties_;
  RobotCurve curve_;
  Shape shape_;
  double max_curvature_;
  Quadrature inner_, outer_;
  std::vector<Sample> samples_;
  std::vector<Span> spans_;
  Worst worst_{};
};

}  // namespace seine::baseline::letter
