#pragma once

#include <span>
#include <vector>

#include "seine/search/coordinator.hpp"

namespace seine::search {

/// Who has to be planned before whom: the robot that stands in another's way at its start must have left (it
/// comes first), and the robot whose goal is in another's way must arrive later (it comes last).
class Precedence {
 public:
  explicit Precedence(const Coordinator& coordinator);

  /// All robots, each after the ones it depends on where that is possible; larger keys first among equals. In
  /// a cycle the robot with the fewest unmet wishes goes first.
  std::vector<int> order(std::span<const double> keys) const;
  bool before(int first, int second) const;

 private:
  std::vector<std::vector<int>> after_;  // by robot: who waits for it, ascending
};

}  // namespace seine::search
