#pragma once

namespace seine {

/// For tests: how often something is tried. Under the sanitizers, where all takes ten to thirty times as long
/// and it is memory that is looked at, less often than otherwise.
constexpr int effort([[maybe_unused]] int usual, [[maybe_unused]] int sanitized) {
#ifdef SEINE_SANITIZED
  return sanitized;
#else
  return usual;
#endif
}

}  // namespace seine
