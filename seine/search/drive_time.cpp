#include "seine/search/drive_time.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace seine::search {
namespace {

using vehicle::Arc;

/// Profiles of one stretch in one gear, from rest to rest.
class StretchTime {
 public:
  explicit StretchTime(const vehicle::Limits& limits) : limits_(limits), acceleration_(limits.acceleration) {
    if (!std::isfinite(acceleration_)) acceleration_ = 1e9;
  }

  /// Appends the time of each arc.
  void add(std::span<const Arc> arcs, std::vector<double>& times);

 private:
  double cap(const Arc& arc) const {
    const double top = arc.distance < 0.0 ? limits_.reverse_speed : limits_.speed;
    const double bend = std::abs(arc.curvature);
    return bend > 0.0 ? std::min(top, std::sqrt(limits_.lateral_acceleration / bend)) : top;
  }
  double gain(const Arc& arc) const { return 2.0 * acceleration_ * std::abs(arc.distance); }

  const vehicle::Limits& limits_;
  double acceleration_;
  std::vector<double> square_;  // of the speed at the joints
};

void StretchTime::add(std::span<const Arc> arcs, std::vector<double>& times) {
  const std::size_t count = arcs.size();
  square_.assign(count + 1, 0.0);
  for (std::size_t i = 1; i < count; ++i) {
    const double slower = std::min(cap(arcs[i - 1]), cap(arcs[i]));
    square_[i] = std::min(slower * slower, square_[i - 1] + gain(arcs[i - 1]));
  }
  for (std::size_t i = count; i-- > 1;) square_[i] = std::min(square_[i], square_[i + 1] + gain(arcs[i]));
  for (std::size_t i = 0; i < count; ++i) {
    const double top = cap(arcs[i]);
    const double from = square_[i], to = square_[i + 1];
    const double peak2 = std::min(top * top, 0.5 * (from + to + gain(arcs[i]))), peak = std::sqrt(peak2);
    const double cruise = std::abs(arcs[i].distance) - (2.0 * peak2 - from - to) / (2.0 * acceleration_);
    const double cruising = cruise > 0.0 ? cruise / peak : 0.0;
    times.push_back((2.0 * peak - std::sqrt(from) - std::sqrt(to)) / acceleration_ + cruising);
  }
}

// An arc between straights is drawn out over so much of them at most (car lengths, and share).
constexpr double kDrawnOut = 1.0, kOfStraight = 0.5;

/// The arcs with the curvatures that a smooth curve in their place would have: a short bend between straights
/// is drawn out over parts of them.
std::vector<Arc> rounded(std::span<const Arc> arcs, double length) {
  std::vector<Arc> smooth(arcs.begin(), arcs.end());
  const auto straight = [&](std::size_t i, int gear) {
    const bool there = i < arcs.size() && arcs[i].curvature == 0.0 && arcs[i].gear() == gear;
    return there ? std::min(kOfStraight * std::abs(arcs[i].distance), kDrawnOut * length) : 0.0;
  };
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (arcs[i].curvature == 0.0) continue;
    const int gear = arcs[i].gear();
    const double own = std::abs(arcs[i].distance);
    const double more = (i > 0 ? straight(i - 1, gear) : 0.0) + straight(i + 1, gear);
    smooth[i].curvature *= own / (own + more);
  }
  return smooth;
}

/// The steering angle an arc has to reach that is driven in so many seconds: a short bend may be drawn out
/// with less, turning the wheel in and out again all the time.
double steering_needed(const Arc& arc, double time, const vehicle::Model& model) {
  const double tangent = model.wheelbase * std::abs(arc.curvature);
  return std::copysign(std::min(std::atan(tangent), std::sqrt(tangent * model.limits.steering_rate * time)),
                       arc.curvature);
}

/// s, waited for the wheel at the joints of arcs: what it takes beyond half of the time of either arc.
double steering_time(std::span<const Arc> arcs, std::span<const double> times, const vehicle::Model& model) {
  double waited = 0.0;
  for (std::size_t i = 1; i < arcs.size(); ++i) {
    const double turn = std::abs(steering_needed(arcs[i], times[i], model) -
                                 steering_needed(arcs[i - 1], times[i - 1], model));
    const double before = i == 1 ? times[0] : 0.5 * times[i - 1];
    const double after = i + 1 == arcs.size() ? times[i] : 0.5 * times[i];
    waited += std::max(0.0, turn / model.limits.steering_rate - before - after);
  }
  return waited;
}

}  // namespace

double drive_time(std::span<const Arc> arcs, const vehicle::Model& model) {
  StretchTime stretch(model.limits);
  const std::vector<Arc> smooth = rounded(arcs, model.length());
  std::vector<double> times;
  times.reserve(arcs.size());
  for (std::size_t from = 0, i = 1; i <= arcs.size(); ++i) {
    if (i < arcs.size() && arcs[i].gear() == arcs[from].gear()) continue;
    stretch.add(std::span(smooth).subspan(from, i - from), times);
    from = i;
  }
  const double driven = std::accumulate(times.begin(), times.end(), 0.0);
  if (!std::isfinite(model.limits.steering_rate) || !std::isfinite(driven)) return driven;
  return driven + steering_time(smooth, times, model);
}

double drive_time(const Path& path, const vehicle::Model& model) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    const double driven = point.gear * (path.points[i + 1].s - point.s);
    if (driven == 0.0) continue;
    if (!arcs.empty() && arcs.back().curvature == point.curvature && arcs.back().gear() == point.gear)
      arcs.back().distance += driven;
    else
      arcs.push_back({point.curvature, driven});
  }
  return drive_time(arcs, model);
}

}  // namespace seine::search
