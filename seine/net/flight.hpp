#pragma once

#include <array>
#include <optional>
#include <vector>

#include "seine/geom/vec3.hpp"
#include "seine/net/target.hpp"

namespace seine::net {

inline constexpr double kGravity = 9.80665;  ///< m/s²
inline constexpr double kErrorSigmas = 2.0;  ///< of the horizontal error ellipse that a catch must cover

struct FlightState {
  double time = 0.0;              ///< s, common clock
  geom::Vec3 position, velocity;  ///< m, m/s
};

/// The instant a target's centre falls through a height, and how well its place is known then.
struct Crossing {
  FlightState state;
  double error = 0.0;  ///< m: kErrorSigmas times the larger half axis of the 1-sigma ellipse below
  /// xx, xy, yy of the place where it passes that height, m². The time of passing is uncertain as well: an
  /// error δz shifts the place by −δz v_xy / v_z.
  std::array<double, 3> covariance{};
};

/// Where a target flies: a = g − drag |v| v from its release on. Before it the target rests at its first
/// state.
class Flight {
 public:
  explicit Flight(const Target& target);

  /// Position to 1e-6 m; in closed form without drag.
  FlightState at(double t) const;

  /// Where its centre falls through `height` (m) for the last time; none when it never does, or only touches
  /// it.
  std::optional<Crossing> crossing(double height) const;

 private:
  std::size_t node_before(double t) const;
  void tabulate();
  std::optional<double> falling_time(double height) const;

  Target target_;
  std::vector<FlightState> nodes_;  // with drag: one Runge-Kutta step apart, from the release to the ground
};

}  // namespace seine::net
