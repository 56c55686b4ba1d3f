#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "seine/sim/catch_watch.hpp"
#include "seine/sim/flight_filter.hpp"
#include "seine/sim/net_physics.hpp"
#include "seine/sim/noise.hpp"
#include "seine/sim/recorder.hpp"
#include "seine/sim/target_sensor.hpp"

namespace seine::sim {

/// One object to catch: how it was announced, how it really flies, how it is seen, and what becomes of it.
class Thrown {
 public:
  /// @param told as the scenario has it; the real throw is drawn from its covariance and the noise's
  Thrown(const net::Target& told, double rim, const Noise& noise, std::uint64_t seed);

  /// Puts it into the scene when its time has come, takes a sight of it when one is due.
  void look(double time, NetPhysics& physics, geom::Vec3 shift);
  /// To be called after every step of the physics.
  void watch(double time, const NetPhysics& physics, std::span<const geom::Vec3> corners);

  const net::Target& told() const { return told_; }
  const net::Target& truth() const { return truth_; }
  double rim() const { return rim_; }  ///< m
  /// As it is known now: seen, or only told.
  net::Target estimate() const;
  bool in_the_air() const { return !watch_ || watch_->fate() == Fate::flying; }
  Fate fate() const { return watch_ ? watch_->fate() : Fate::flying; }
  const CatchWatch* verdict() const { return watch_ ? &*watch_ : nullptr; }
  TargetRecord record(const NetPhysics& physics);

 private:
  net::Target told_, truth_;
  double rim_;
  TargetSensor sensor_;
  FlightFilter filter_;
  std::size_t ball_ = 0;
  std::optional<CatchWatch> watch_;
  std::optional<geom::Vec3> seen_;
};

}  // namespace seine::sim
