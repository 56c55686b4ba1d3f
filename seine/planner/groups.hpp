#pragma once

#include <vector>

#include "seine/trajopt/proximity.hpp"

namespace seine::planner {

/// Who belongs together: a union-find over 0 … count − 1.
class Groups {
 public:
  explicit Groups(int count);
  void join(int a, int b);
  /// Every group, members ascending, groups by their first member.
  std::vector<std::vector<int>> all() const;

 private:
  int root(int member) const;
  std::vector<int> parent_;
};

/// Whether two bodies come within `gap` (units) of each other at some tick they are sampled at (every few).
bool come_within(const trajopt::Body& a, const trajopt::Body& b, double gap);

}  // namespace seine::planner
