#pragma once

#include <atomic>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "seine/certify/certificate.hpp"

namespace seine::certify {

/// A violation with how bad it is, to keep the worst of its sort: by how much it is over, in units of its
/// own.
struct Finding {
  Violation violation;
  double excess = 0.0;
};

/// Collects what one quantity or pair breaks over consecutive intervals; intervals that touch are one
/// episode.
class Episodes {
 public:
  struct Episode {
    double t0, t1;  ///< s, the intervals it was met in
    double time;    ///< s, of the worst instant
    double value;
    double excess;
  };
  /// Intervals come in order of time.
  void offer(double t0, double t1, double time, double value, double excess);
  const std::vector<Episode>& all() const { return episodes_; }

 private:
  std::vector<Episode> episodes_;
};

/// What every part of the proof needs: the question, and whether to go on.
struct Context {
  const world::Scenario& scenario;
  const world::StaticMap& map;
  const Options& options;
  double braking_from = std::numeric_limits<double>::infinity();  ///< s, something lies in the net
  struct Carry {
    double from, speed;  ///< s, m/s
    int target;
  };
  static constexpr std::size_t kMostCarries = 20;
  /// From then on no car drives faster, for the sake of that target: by time, each stricter than all before;
  /// at most kMostCarries.
  std::vector<Carry> carries;
  std::atomic<bool> expired{false};

  /// True once the deadline has passed; looks at the clock.
  bool out_of_time() {
    if (!expired.load(std::memory_order_relaxed) && options.deadline.expired()) expired = true;
    return expired.load(std::memory_order_relaxed);
  }
  std::string robot_name(int robot) const;
  std::string obstacle_name(int obstacle) const;
  std::string target_name(int target) const;
  /// Of an obstacle, m; of the map's cells (−1) infinite.
  double height_of(int obstacle) const;
};

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// Two numbers as text, with four digits or as many as it takes to tell them apart.
std::pair<std::string, std::string> told_apart(double value, double limit);

/// The worst `per_sort` of each (kind, robot, other), by time.
std::vector<Violation> worst_of_each(std::vector<Finding> findings, int per_sort);

}  // namespace seine::certify
