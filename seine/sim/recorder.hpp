#pragma once

#include <optional>
#include <string>
#include <vector>

#include "seine/net/target.hpp"
#include "seine/sim/car_plant.hpp"
#include "seine/sim/catch_watch.hpp"
#include "seine/sim/net_physics.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::sim {

/// Something worth telling.
struct Note {
  double time = 0.0;  ///< s
  std::string text;
};

struct CarRecord {
  CarState truth, belief;
  traj::State reference;
  Command command;
  geom::Vec2 pull;  ///< N, of the net
};

struct TargetRecord {
  Ball ball;
  Fate fate = Fate::flying;
  bool present = false;                 ///< released
  bool touching = false;                ///< the net
  std::optional<geom::Vec3> seen;       ///< m, last delivered since the record before
  std::optional<net::Target> estimate;  ///< from what was seen
};

/// Every signal at one instant.
struct Record {
  double time = 0.0;       ///< s
  double plan_time = 0.0;  ///< s, on the clock of the plan that is followed
  double plan_rate = 1.0;
  std::vector<CarRecord> cars;
  std::vector<TargetRecord> targets;
  const NetMesh* mesh = nullptr;  ///< of the net, where there is one …
  std::vector<geom::Vec3> nodes;  ///< … and where it is, m
};

/// Takes down what happens in a simulation.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void begin(const world::Scenario& scenario) = 0;
  virtual void record(const Record& record) = 0;
  virtual void note(const Note& note) = 0;
  virtual void end() = 0;
};

}  // namespace seine::sim
