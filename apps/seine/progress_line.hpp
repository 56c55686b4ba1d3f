#pragma once

#include <mutex>
#include <string>

#include "seine/base/deadline.hpp"

namespace seine::app {

/// One line on stderr that is rewritten in place: only where stderr is a terminal, only after the first
/// second, at most ten times a second; gone when the object is. May be called from several threads.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @param fraction 0 … 1 of the stage; negative where it is not known
  void update(const std::string& stage, double fraction);
  /// Removes the line, for other output; the next update draws it again.
  void clear();

 private:
  std::mutex mutex_;
  Stopwatch since_;
  double drawn_at_ = 0.0;  // s
  bool terminal_;
  bool visible_ = false;
};

}  // namespace seine::app
