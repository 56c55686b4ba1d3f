#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "seine/baseline/letter/settings.hpp"
#include "seine/planner/planner.hpp"

namespace seine::bench {

/// What came of a method's plans for one group of tasks.
class Tally {
 public:
  /// @param patience what a continuous check grants the plans in column "within"
  explicit Tally(const baseline::letter::Settings& patience = {}) : patience_(patience) {}

  /// @param seconds CPU time it took
  void add(const planner::PlanResult& result, double seconds);
  /// Head of the table, in two lines.
  static void print_head();
  /// One line; travel times, distance and cost are means over the plans that the method stands by.
  void print(const std::string& name) const;
  /// How the targets lie in the nets, claimed or not; nothing where there are none.
  void print_catches() const;
  /// Which rules the certificate found broken in the plans that were claimed, and in how many of them.
  void print_broken() const;

 private:
  bool within(const certify::Certificate& certificate) const;

  baseline::letter::Settings patience_;
  int asked_ = 0, claimed_ = 0, certified_ = 0, within_ = 0;
  std::vector<double> compute_, evaluations_;
  std::vector<double> rim_margin_, opening_;  // of every catch
  planner::Quality sum_;
  int counted_ = 0;
  std::map<certify::Kind, int> broken_;
};

}  // namespace seine::bench
