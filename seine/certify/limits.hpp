#pragma once

#include <array>
#include <vector>

#include "seine/certify/report.hpp"
#include "seine/certify/stretch.hpp"

namespace seine::certify {

/// Proves one car's limits, cell by cell in order of time: each quantity stays within max(|f(a)|, |f(b)|) + ⅛
/// sup|f''| (b − a)² on [a, b], and cells are halved until that is within the limit or a value beyond it has
/// been met.
class LimitProof {
 public:
  LimitProof(Context& context, int robot);

  /// One cell. @param direction of u: +1 never back, −1 never on, 0 either
  void check(const Stretch& stretch, const Sample& a, const Sample& b, const Bends& bends, int direction);
  std::vector<Finding> findings() const;

 private:
  struct Rule {
    Kind kind;
    Quantity quantity;
    int other = -1;  ///< the target for whose sake it is
    double sign;     ///< 0: of the magnitude; −1: of minus the value
    double limit;
    double seen;             ///< a value beyond it is a violation
    double proved;           ///< what is to be proved
    double worst = 0.0;      ///< in the cell at hand, 0 when kept
    bool undecided = false;  ///< somewhere
    double undecided_time = 0.0;
    Episodes episodes;
  };
  using Mask = unsigned;

  /// @param unit of the quantity, for the car at hand
  static Rule rule(Kind kind, Quantity quantity, double limit, double unit);
  static double measure(const Rule& rule, const Sample& sample);
  /// A limit that holds from a catch on, on what lies after it of a cell.
  void check_from(double begin, std::size_t rule, const Stretch& stretch, const Sample& a, const Sample& b,
                  const Bends& bends);
  /// Of the rules in `mask`, those not proved on the cell.
  Mask unproved(Mask mask, const Stretch& stretch, const Sample& a, const Sample& b, const Bends& bends);
  std::size_t most_steps() const;
  void refine(Mask mask, const Stretch& stretch, const Sample& a, const Sample& b, int depth);

  Context& context_;
  int robot_;
  double wheelbase_;
  double reach_;
  std::vector<Rule> rules_;  // those of RuleIndex, then one for each of the context's carries
  double cell_begin_ = 0.0, cell_end_ = 0.0;
  bool monotone_ = true;  // u, on the cell at hand
  bool refuted_ = false;
  std::size_t steps_ = 0, cells_ = 0;
};

}  // namespace seine::certify
