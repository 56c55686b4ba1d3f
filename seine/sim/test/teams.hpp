#pragma once

#include <vector>

#include "seine/base/effort.hpp"

namespace seine::sim {

/// The teams that are tried.
inline std::vector<int> teams() {
  return effort(1, 0) == 1 ? std::vector<int>{3, 4, 6} : std::vector<int>{3};
}

}  // namespace seine::sim
