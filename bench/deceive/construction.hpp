#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::deceive {

/// A question and a plan that claims to answer it.
struct Case {
  std::string name;
  world::Scenario scenario;
  traj::TeamTrajectory plan;
};

/// Numbers in [0, 1] that a construction turns into its parameters, one after the other: what the search
/// varies. Missing ones are 0.5.
class Genes {
 public:
  explicit Genes(std::span<const double> values) : values_(values) {}
  double uniform(double low, double high) { return low + (high - low) * next(); }
  /// Evenly in the logarithm; low > 0.
  double log(double low, double high) { return low * std::pow(high / low, next()); }
  int below(int count) { return std::min(count - 1, static_cast<int>(next() * count)); }
  bool coin() { return next() < 0.5; }

 private:
  double next() { return used_ < values_.size() ? values_[used_++] : 0.5; }
  std::span<const double> values_;
  std::size_t used_ = 0;
};

/// A way to deceive, with parameters.
struct Construction {
  const char* name;
  Case (*build)(Genes genes);
};
inline constexpr std::size_t kGenes = 16;  ///< more than any construction asks for

/// All of them: one for each fault that was found by hand, and what is akin to it.
std::vector<Construction> constructions();
// By what they abuse.
void add_tangent_constructions(std::vector<Construction>& all);  ///< places where |p'| vanishes
void add_joint_constructions(std::vector<Construction>& all);    ///< tolerances that add up
void add_world_constructions(std::vector<Construction>& all);    ///< small cars, low limits, maps

// Parts.

/// A car whose footprint is `length` long; limits of the standard car, scaled unless given.
vehicle::Model car(double length);
/// The quintic from one value to another, at rest to the second derivative at both ends.
traj::Quintic ramp(double from, double to);
inline traj::Quintic constant(double value) {
  return {value, 0.0, 0.0, 0.0, 0.0, 0.0};
}
inline traj::Quintic linear(double value, double slope) {
  return {value, slope, 0.0, 0.0, 0.0, 0.0};
}
/// c(w) along a direction from a place, as a curve piece.
std::array<traj::Quintic, 2> along(geom::Vec2 from, geom::Vec2 direction, const traj::Quintic& c);
/// Starts and goals where the plan really begins and ends; wide bounds around everything.
Case case_of(const char* name, const vehicle::Model& model, traj::TeamTrajectory plan);

}  // namespace seine::deceive
