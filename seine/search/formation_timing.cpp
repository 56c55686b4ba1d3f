// When a formation is where on its path.
#include <algorithm>
#include <cmath>

#include "seine/search/formation.hpp"

namespace seine::search {
namespace {

// Shares of the limits that a guess uses: the optimiser needs something to give.
constexpr double kSpeedShare = 0.95, kAccelerationShare = 0.8, kLateralShare = 0.8;
constexpr int kBisections = 40;
constexpr double kLeastSpeed = 1e-3;  // of the top speed: the slowest cap that is tried

struct Caps {
  std::vector<double> speed;  // per point of the path
  double acceleration;        // m/s²
};

Caps caps_of(const FormationPath& way, const world::Scenario& scenario) {
  Caps caps{{}, std::numeric_limits<double>::infinity()};
  const auto& points = way.path.points;
  caps.speed.assign(points.size(), std::numeric_limits<double>::infinity());
  for (const world::Robot& robot : scenario.robots) {
    const vehicle::Limits& limits = scenario.model_of(robot).limits;
    caps.acceleration = std::min(caps.acceleration, kAccelerationShare * limits.acceleration);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // A point's own stretch and the one that ends there.
      const double bend =
          std::max(std::abs(points[i].curvature), i > 0 ? std::abs(points[i - 1].curvature) : 0.0);
      const double top = kSpeedShare * (points[i].gear > 0 ? limits.speed : limits.reverse_speed);
      const double turn = bend > 0.0 ? std::sqrt(kLateralShare * limits.lateral_acceleration / bend) : top;
      caps.speed[i] = std::min({caps.speed[i], top, turn});
    }
  }
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].gear != points[i - 1].gear) caps.speed[i] = caps.speed[i - 1] = 0.0;
  caps.speed.back() = 0.0;
  return caps;
}

// Forward and backward pass: v² changes by at most 2 a Δs.
std::vector<double> speeds_under(const std::vector<double>& caps, const Path& path, double acceleration,
                                 double start_speed) {
  std::vector<double> v = caps;
  v.front() = start_speed;
  const auto& points = path.points;
  for (std::size_t i = 1; i < v.size(); ++i)
    v[i] =
        std::min(v[i], std::sqrt(v[i - 1] * v[i - 1] + 2.0 * acceleration * (points[i].s - points[i - 1].s)));
  for (std::size_t i = v.size() - 1; i-- > 1;)
    v[i] =
        std::min(v[i], std::sqrt(v[i + 1] * v[i + 1] + 2.0 * acceleration * (points[i + 1].s - points[i].s)));
  return v;
}

std::vector<ProfileKnot> profile_of(const std::vector<double>& v, const Path& path) {
  std::vector<ProfileKnot> profile;
  double t = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double ds = i > 0 ? path.points[i].s - path.points[i - 1].s : 0.0;
    if (ds > 0.0) t += 2.0 * ds / (v[i] + v[i - 1]);
    if (i > 0 && ds <= 0.0) continue;
    profile.push_back({t, path.points[i].s, v[i]});
  }
  return profile;
}

double time_at(const std::vector<ProfileKnot>& profile, double s) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (profile[i].s < s) continue;
    const ProfileKnot &a = profile[i - 1], &b = profile[i];
    const double share = (s - a.s) / (b.s - a.s);
    const double v = std::sqrt(std::lerp(a.v * a.v, b.v * b.v, share));
    return a.t + 2.0 * (s - a.s) / std::max(a.v + v, 1e-9);
  }
  return profile.empty() ? 0.0 : profile.back().t;
}

}  // namespace

FormationTiming time_formation(const FormationPath& way, const FormationProblem& problem) {
  const Caps caps = caps_of(way, *problem.scenario);
  const auto& points = way.path.points;
  std::vector<double> capped = caps.speed;
  for (std::size_t m = 0; m < way.meeting_s.size(); ++m)
    for (std::size_t i = 0; i < capped.size(); ++i)
      if (points[i].s >= way.meeting_s[m]) capped[i] = std::min(capped[i], problem.meetings[m].onward);
  const double top = *std::max_element(caps.speed.begin(), caps.speed.end());
  const double start = std::min(std::abs(problem.start_speed), top);
  FormationTiming timing;
  timing.profile = profile_of(speeds_under(capped, way.path, caps.acceleration, start), way.path);
  double from = 0.0;
  for (std::size_t m = 0; m < way.meeting_s.size(); ++m) {
    const double s = way.meeting_s[m], wanted = problem.meetings[m].time - timing.wait;
    if (s <= 0.0) {
      timing.wait = std::max(timing.wait, problem.meetings[m].time);
      continue;
    }
    timing.slack = std::min(timing.slack, wanted - time_at(timing.profile, s));
    // The slowest cap before the rendezvous that is not late.
    double low = kLeastSpeed * top, high = top;
    const auto with_cap = [&](double cap) {
      std::vector<double> v = capped;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (points[i].s > from && points[i].s <= s) v[i] = std::min(v[i], cap);
      return v;
    };
    for (int k = 0; k < kBisections && high - low > 1e-4 * top; ++k) {
      const double cap = 0.5 * (low + high);
      const auto profile =
          profile_of(speeds_under(with_cap(cap), way.path, caps.acceleration, start), way.path);
      (time_at(profile, s) > wanted ? low : high) = cap;
    }
    capped = with_cap(high);
    timing.profile = profile_of(speeds_under(capped, way.path, caps.acceleration, start), way.path);
    from = s;
  }
  return timing;
}

}  // namespace seine::search
