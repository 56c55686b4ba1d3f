#include "seine/sim/net_material.hpp"

#include <array>
#include <cstddef>

namespace seine::sim {
namespace {

struct Measured {
  double rebound;  // 90th percentile of 200 drops each on nets of three, four and six corners
  double holding;  // 1/s
};
constexpr std::array kMeasured{
    Measured{kMostRebound, 0.0},   Measured{0.715, 2.0},  Measured{0.627, 4.0},  Measured{0.532, 6.0},
    Measured{0.429, 8.0},          Measured{0.341, 10.0}, Measured{0.301, 12.0}, Measured{0.276, 14.0},
    Measured{0.259, 16.0},         Measured{0.246, 18.0}, Measured{0.237, 20.0}, Measured{0.225, 24.0},
    Measured{kLeastRebound, 30.0},
};

double holding_of(double rebound) {
  if (rebound >= kMostRebound) return kMeasured.front().holding;
  for (std::size_t i = 1; i < kMeasured.size(); ++i) {
    const Measured &more = kMeasured[i - 1], &less = kMeasured[i];
    if (rebound < less.rebound) continue;
    const double part = (more.rebound - rebound) / (more.rebound - less.rebound);
    return more.holding + part * (less.holding - more.holding);
  }
  return kMeasured.back().holding;
}

}  // namespace

NetMaterial material_of_rebound(double rebound) {
  return {.holding = holding_of(rebound)};
}

}  // namespace seine::sim
