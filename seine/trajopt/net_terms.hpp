#pragma once

#include <span>
#include <vector>

#include "seine/trajopt/net_task.hpp"
#include "seine/trajopt/robot_problem.hpp"
#include "seine/trajopt/settings.hpp"

namespace seine::trajopt {

/// The terms that tie a team to its net, on the common clock: at ticks (size, topology, what is in the way)
/// and at single moments (the catch, the delivery). All inside in `Units`; the adjoint goes into the cars'
/// ClockStates.
class NetTerms {
 public:
  /// @param tick units of time between two ticks; the terms look at every `stride`-th
  NetTerms(const NetTask& task, const Units& units, const Settings& settings, double tick, int stride);

  /// Times (units) at which the cars' states are needed besides the ticks; the last one is the end.
  const std::vector<double>& moments() const { return moments_; }
  /// Finds what is near the net. @param states cars × ticks, of which every stride-th is read
  /// @param ticks how many count @param row states a car
  void rebuild(std::span<const ClockState> states, int ticks, int row);
  int ticks() const { return static_cast<int>(looks_.size()) * stride_; }

  static constexpr int kChunks = 8;
  /// Cost of the terms at one chunk of the ticks; adds to the states' gradients.
  double at_ticks(int chunk, std::span<ClockState> states, int row, double knee) const;
  /// Cost of the terms at the moments. @param states cars × moments
  double at_moments(std::span<ClockState> states, double knee) const;
  /// Cost of driving too fast with something in the net that the air blows out of it, between the ticks; adds
  /// to the states' gradients. @param states as for at_ticks
  double on_the_way(std::span<ClockState> states, int row, double knee) const;

 private:
  // What is near the net at one tick.
  struct Look {
    std::vector<std::pair<const std::vector<geom::Vec2>*, double>> tall;  // core, clearance with its radius
    bool loaded = false;
    double least_spread = 0.0;
    double opening = 0.0;
  };
  struct Catch {
    std::size_t rim, before, after;  // moments
    CatchTask task;                  // units
  };
  // The ring at one instant, and ∂J/∂ of it.
  struct Ring {
    std::vector<geom::Vec2> at, gradient, scratch;
  };

  void place(std::span<const ClockState> states, std::size_t first, std::size_t row, Ring& ring) const;
  void pull(std::span<ClockState> states, std::size_t first, std::size_t row, const Ring& ring) const;
  double at_tick(const Look& look, Ring& ring, double knee) const;
  double size_cost(const Look& look, Ring& ring, double knee) const;
  double hold_cost(Ring& ring, double knee) const;
  double shape_cost(const Look& look, Ring& ring, double knee) const;
  double inside(Ring& ring, geom::Vec2 point, double margin, double knee, geom::Vec2& g_point) const;
  double opening_cost(const Catch& c, Ring& ring, double knee) const;
  double catch_cost(const Catch& c, std::span<ClockState> states, double knee) const;
  double delivery_cost(std::span<ClockState> states, double knee) const;
  double spread_for(double depth) const;
  void look_at(Look& look, double time, std::span<const geom::Vec2> ring);

  NetTask task_;  // units
  Settings settings_;
  int stride_;
  double tick_, tick_weight_, moment_weight_, slack_, units_length_ = 1.0;
  std::vector<double> rest_;  // N × N distances at rest
  double rest_spread_ = 0.0, rest_opening_ = 0.0;
  std::vector<double> moments_;
  std::vector<Catch> catches_;
  std::vector<Look> looks_;
  std::vector<std::vector<geom::Vec2>> tall_;  // cores of task.tall's pieces, units
};

}  // namespace seine::trajopt
