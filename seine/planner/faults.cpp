#include "seine/planner/faults.hpp"

#include <algorithm>
#include <cmath>

namespace seine::planner {
namespace {

using certify::Kind;

constexpr double kDistance = 0.1, kShare = 0.5, kCatchShare = 0.1, kSpeed = 0.1, kOpening = 0.05,
                 kReserve = 1.0;

double severity_of(const certify::Violation& v) {
  const double missed = std::abs(v.value - v.limit);
  switch (v.kind) {
    case Kind::speed:
    case Kind::reverse_speed:
    case Kind::acceleration:
    case Kind::lateral_acceleration:
    case Kind::curvature:
    case Kind::steering_rate:
    case Kind::carrying:
      return missed / (kShare * v.limit);
    case Kind::gear:
      return missed / kSpeed;
    case Kind::net_opening:
      return missed / kOpening;
    case Kind::net_holding:
      return missed / kReserve;
    case Kind::target_catch:  // a margin in metres, an opening, or a speed
      return missed / std::max(kDistance, kCatchShare * v.limit);
    default:
      return missed / kDistance;
  }
}

}  // namespace

double severity(const certify::Certificate& certificate) {
  const certify::Violation* v = worst(certificate);
  return v == nullptr ? 0.0 : severity_of(*v);
}

const certify::Violation* worst(const certify::Certificate& certificate) {
  const auto& all = certificate.violations;
  const auto found = std::ranges::max_element(all, {}, severity_of);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace seine::planner
