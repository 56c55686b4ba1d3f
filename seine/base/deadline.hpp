#pragma once

#include <atomic>
#include <chrono>
#include <limits>

namespace seine {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// When to give up: a moment in time, a flag somebody else may raise, or both. Copies share the flag.
class Deadline {
 public:
  /// Never expires.
  Deadline() = default;
  /// Expires `seconds` from now, or when `*cancelled` becomes true (it must outlive every copy).
  explicit Deadline(double seconds, const std::atomic<bool>* cancelled = nullptr)
      : cancelled_(cancelled), seconds_(seconds) {}

  double remaining() const {
    if (cancelled_ != nullptr && cancelled_->load(std::memory_order_relaxed)) return 0.0;
    return seconds_ - since_.seconds();
  }
  bool expired() const { return remaining() <= 0.0; }
  /// The earlier of this deadline and `seconds` from now.
  Deadline within(double seconds) const {
    const double left = remaining();
    return Deadline(seconds < left ? seconds : left, cancelled_);
  }

 private:
  Stopwatch since_;
  const std::atomic<bool>* cancelled_ = nullptr;
  double seconds_ = std::numeric_limits<double>::infinity();
};

}  // namespace seine
