#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/sim/thrown.hpp"

namespace seine::sim {

/// The net, what is thrown at it or lies in it, and what becomes of that.
class Scene {
 public:
  /// @param corners where the net is held at first; it hangs still then, a payload in it
  Scene(const world::Scenario& scenario, std::span<const geom::Vec3> corners, const Noise& noise, Rng& seeds);

  /// Releases objects when their time has come and takes sights of them.
  void look(double time, const std::vector<Faults::TargetJump>& jumps);
  /// Lets one step pass that ends at `time` with the net held at `corners`.
  void advance(double time, double duration, std::span<const geom::Vec3> corners);

  std::span<const geom::Vec3> pulls() const { return physics_->pulls(); }
  /// Targets that have not reached the rim, as they are known.
  std::vector<net::Target> in_the_air() const;
  /// When the last target really falls through the rim, s; 0 without targets.
  double last_crossing() const { return last_crossing_; }
  /// One for each target, or for the payload. `arrived`: the team is where things must be delivered.
  std::vector<Outcome> outcomes(bool arrived) const;
  /// What became of objects since the last call, a sentence each.
  std::vector<std::string> news();
  void record(Record& record);

 private:
  void put_payload(const world::Scenario& scenario, std::span<const geom::Vec3> corners);

  std::unique_ptr<NetPhysics> physics_;
  std::vector<Thrown> thrown_;
  std::optional<CatchWatch> payload_;
  std::vector<Fate> known_;     // fates that were told
  double last_crossing_ = 0.0;  // s
};

}  // namespace seine::sim
