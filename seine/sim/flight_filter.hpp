#pragma once

#include <array>
#include <optional>

#include "seine/geom/vec3.hpp"
#include "seine/net/target.hpp"
#include "seine/sim/small_matrix.hpp"

namespace seine::sim {

/// What is known about flights before one is seen.
struct FilterOptions {
  double noise = 0.01;        ///< m, standard deviation of an observation along each axis
  double drag = 0.05;         ///< 1/m …
  double drag_error = 0.1;    ///< … and its standard deviation
  double push_error = 0.3;    ///< m/s², of a steady acceleration nobody told of: spin, wind, a tilted camera
  double speed_error = 10.0;  ///< m/s, of a flight seen for the first time
  double gate = 16.27;  ///< squared Mahalanobis distance (χ², 3 degrees, 99.9 %): farther is an outlier
  int patience = 5;     ///< after so many outliers in a row it is the track that is wrong
};

/// Extended Kalman filter of one flight [BarShalom01, section 10.3]: position, velocity, drag, and a steady
/// push that stands for what the model lacks, a = g + push − drag |v| v.
class FlightFilter {
 public:
  explicit FlightFilter(const FilterOptions& options = {}) : options_(options) {}

  /// Takes a throw that was told: its state and covariance at its time, its drag.
  void expect(const net::Target& told);
  /// One observation of the position, in order of time. False when it was left out as an outlier.
  bool observe(double time, geom::Vec3 position);

  bool tracking() const { return started_; }
  double time() const { return time_; }  ///< s, of the last observation
  geom::Vec3 position() const { return {state_[0], state_[1], state_[2]}; }
  geom::Vec3 velocity() const { return {state_[3], state_[4], state_[5]}; }
  double drag() const { return state_[6]; }
  geom::Vec3 push() const { return {state_[7], state_[8], state_[9]}; }
  /// Where the object is expected at a later time, m.
  geom::Vec3 position_at(double time) const;

  /// The flight as others see it, from time() on: a target without push that falls through the height `rim`
  /// (m) where and when this one does, with the covariance that its place has then. Radius and mass are those
  /// of `like`. None while nothing is tracked.
  std::optional<net::Target> target(const net::Target& like, double rim) const;

 private:
  static constexpr std::size_t kSize = 10;
  using State = std::array<double, kSize>;
  using Matrix = SmallMatrix<kSize, kSize>;

  void start(double time, geom::Vec3 position);
  void predict(double duration);
  Matrix transition(double h) const;
  double surprise(geom::Vec3 position) const;
  void correct(geom::Vec3 position);
  void doubt(geom::Vec3 position);
  double time_to_fall(double height) const;

  FilterOptions options_;
  bool started_ = false;
  double time_ = 0.0;
  State state_{};
  Matrix covariance_{};
  int outliers_ = 0;  // in a row
};

}  // namespace seine::sim
