#pragma once

#include <vector>

#include "seine/mpc/model.hpp"

namespace seine::mpc {

/// What the inputs do between a command and its effect: nothing for `dead_time`, then they follow with the
/// time constant `lag` (first order). The tracker plans inputs, sends commands, and keeps the inputs in its
/// head where they are not measured.
class Actuators {
 public:
  Actuators(double dead_time, double lag, double period);

  void reset(const Input& acting);
  /// What acts now, where it is measured.
  void observe(const Input& acting) { acting_ = acting; }
  /// Where the car will be, and with which inputs, when the next command begins to act.
  struct Outlook {
    State state;
    Input acting;
  };
  Outlook outlook(const State& now, double wheelbase) const;
  /// The command that makes the input `wanted` on average over its period, from `acting` on.
  Input command_for(const Input& wanted, const Input& acting) const;
  /// How much of an input is still there, on average over a period, whatever is commanded.
  static double kept_on_average(double lag, double duration);
  /// One period passes, with a new command sent at its begin. Returns where it takes the car.
  State send(const Input& command, const State& now, double wheelbase);

 private:
  Outlook follow(Outlook from, const Input& command, double wheelbase, double dt) const;

  double dead_time_, lag_, period_;
  Input acting_;                 // at now
  std::vector<Input> underway_;  // commands that have not acted to their end, the oldest first
};

}  // namespace seine::mpc
