#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace seine::bench {

/// The value below which the share `part` of `values` lies; not a number without values.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(part * last))];
}

/// How far a part has come, on a line of its own that is overwritten; gone when all is done.
inline void progress(const char* what, int done, int all) {
  if (done < all) {
    std::fprintf(stderr, "\r%s: %d of %d  ", what, done, all);
  } else {
    std::fputs("\r\033[K", stderr);
  }
}

}  // namespace seine::bench
