#pragma once

#include <array>

#include "seine/sim/recorder.hpp"

namespace seine::sim {

/// A number of a record and what logs call it. SI units.
struct Signal {
  const char* name;
  double value;
};

/// Everything that is recorded of a car.
inline std::array<Signal, 18> signals_of(const CarRecord& car) {
  const CarState &t = car.truth, &b = car.belief;
  const traj::State& r = car.reference;
  return {{{"x", t.pose.x},
           {"y", t.pose.y},
           {"heading", t.pose.heading},
           {"speed", t.speed},
           {"acceleration", t.acceleration},
           {"steering", t.steering},
           {"believed_x", b.pose.x},
           {"believed_y", b.pose.y},
           {"believed_heading", b.pose.heading},
           {"believed_speed", b.speed},
           {"reference_x", r.pose.x},
           {"reference_y", r.pose.y},
           {"reference_heading", r.pose.heading},
           {"reference_speed", r.speed},
           {"commanded_acceleration", car.command.acceleration},
           {"commanded_steering", car.command.steering},
           {"pull_x", car.pull.x},
           {"pull_y", car.pull.y}}};
}

}  // namespace seine::sim
