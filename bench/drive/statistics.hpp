#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace seine::bench {

/// The value below which the share `part` of `values` lies; not a number without values.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(part * last))];
}

/// CPU time of this thread, s: what else runs on the machine does not count.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
