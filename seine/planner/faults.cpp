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

bool folds(const traj::RobotTrajectory& car) {
  constexpr int kSamples = 64;  // a piece: no car turns by 90° in a part so short
  const auto slope = [](const traj::Quintic& c, double w) {
    return c[1] + w * (2.0 * c[2] + w * (3.0 * c[3] + w * (4.0 * c[4] + w * 5.0 * c[5])));
  };
  for (const traj::Segment& segment : car.segments)
    for (const auto& piece : segment.curve) {
      geom::Vec2 before{slope(piece[0], 0.0), slope(piece[1], 0.0)};
      for (int i = 1; i <= kSamples; ++i) {
        const double w = static_cast<double>(i) / kSamples;
        const geom::Vec2 now{slope(piece[0], w), slope(piece[1], w)};
        if (geom::dot(before, now) < 0.0) return true;
        before = now;
      }
    }
  return false;
}

const certify::Violation* worst(const certify::Certificate& certificate) {
  const auto& all = certificate.violations;
  const auto found = std::ranges::max_element(all, {}, severity_of);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace seine::planner
