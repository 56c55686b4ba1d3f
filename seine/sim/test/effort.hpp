#pragma once

#include <vector>

namespace seine::sim {

/// How often something is tried: under the sanitizers, where all takes ten to thirty times as long and it is
/// memory that is looked at, less often than otherwise.
constexpr int effort([[maybe_unused]] int usual, [[maybe_unused]] int sanitized) {
#ifdef SEINE_SANITIZED
  return sanitized;
#else
  return usual;
#endif
}

/// The teams that are tried.
inline std::vector<int> teams() {
  return effort(1, 0) == 1 ? std::vector<int>{3, 4, 6} : std::vector<int>{3};
}

}  // namespace seine::sim
