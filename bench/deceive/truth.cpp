#include "bench/deceive/truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace seine::deceive {
namespace {

/// The clock and, in between, every instant by which a car has got a fiftieth of its length further.
void add_times(const std::vector<Sight>& track, double length, std::vector<double>& times) {
  const Sight* kept = nullptr;
  for (const Sight& s : track) {
    const bool far = kept == nullptr || std::hypot(s.x - kept->x, s.y - kept->y) > 0.02 * length ||
                     std::abs(geom::wrap_angle(s.heading - kept->heading)) > 0.02;
    if (!far) continue;
    if (kept != nullptr && times.size() < 4'000'000) times.push_back(s.t);
    kept = &s;
  }
}

double last_event(const world::Scenario& scenario, const traj::TeamTrajectory& plan) {
  double last = 0.0;
  for (const auto& way : plan.robots) {
    double arrival = 0.0;
    for (const auto& segment : way.segments)
      arrival += segment.wait + segment.piece_duration * static_cast<double>(segment.progress.size());
    last = std::max(last, arrival);
  }
  for (const auto& obstacle : scenario.obstacles)
    if (!obstacle.motion.empty()) last = std::max(last, obstacle.motion.back().t);
  return last;
}

std::vector<double> clock(double last, double hertz) {
  const double count = std::min(std::ceil(last * hertz), 2e6);
  std::vector<double> times;
  for (double i = 0.0; i <= count; ++i) times.push_back(count > 0.0 ? last * i / count : 0.0);
  return times;
}

}  // namespace

Scale scale_of(const vehicle::Model& model, const Grants& grants) {
  double back = 0.0, front = 0.0;
  for (const geom::Vec2 p : model.footprint) back = std::min(back, p.x), front = std::max(front, p.x);
  const double length = front - back;
  Scale scale{std::min(1.0, length / grants.short_car),
              std::min({1.0, model.limits.speed, std::sqrt(model.limits.acceleration * length)})};
  if (model.limits.reverse_speed > 0.0) scale.pace = std::min(scale.pace, model.limits.reverse_speed);
  return scale;
}

void Ledger::offer(const char* what, double time, double value, double limit, double granted, int other) {
  double ratio = (value - limit) / granted;
  if (std::isnan(ratio)) ratio = std::numeric_limits<double>::infinity();
  for (Fault& fault : faults_) {
    if (fault.other != other || fault.what != what) continue;
    if (ratio > fault.ratio) fault = {what, robot_, other, time, value, limit, ratio};
    return;
  }
  faults_.push_back({what, robot_, other, time, value, limit, ratio});
}

std::vector<Fault> look_at(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                           const Look& look, const Grants& grants) {
  std::vector<Fault> all;
  const auto take = [&all](Ledger& ledger) {
    for (Fault& fault : ledger.faults()) all.push_back(std::move(fault));
  };
  const std::vector<double> ticks = clock(last_event(scenario, plan), look.hertz);
  std::vector<std::vector<double>> own(plan.robots.size());
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const std::vector<Sight> seen = track(plan.robots[k], look);
    Ledger ledger(static_cast<int>(k));
    look_at_drive(scenario, static_cast<int>(k), plan.robots[k], seen, grants, ledger);
    add_times(seen, scenario.model_of(scenario.robots[k]).length(), own[k]);
    std::vector<double> times = ticks;
    times.insert(times.end(), own[k].begin(), own[k].end());
    std::sort(times.begin(), times.end());
    look_at_ground(scenario, static_cast<int>(k), plan.robots[k], times, grants, ledger);
    take(ledger);
  }
  for (std::size_t a = 0; a < plan.robots.size(); ++a) {
    Ledger ledger(static_cast<int>(a));
    for (std::size_t b = a + 1; b < plan.robots.size(); ++b) {
      std::vector<double> times = ticks;
      times.insert(times.end(), own[a].begin(), own[a].end());
      times.insert(times.end(), own[b].begin(), own[b].end());
      look_at_pair(scenario, static_cast<int>(a), static_cast<int>(b), plan, times, grants, ledger);
    }
    take(ledger);
  }
  if (scenario.net) {
    Ledger ledger(-1);
    look_at_net(scenario, plan, ticks, grants, ledger);
    take(ledger);
  }
  return all;
}

double worst_ratio(const std::vector<Fault>& faults) {
  double worst = 0.0;
  for (const Fault& fault : faults) worst = std::max(worst, fault.ratio);
  return worst;
}

std::string describe(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) {
    if (!(f.ratio > 1.0)) continue;
    char line[200];
    std::snprintf(line, sizeof line,
                  "    car %d%s: %s %.8g, allowed %.8g (t = %.6f s, %.3g x the tolerance)\n", f.robot,
                  f.other >= 0 ? (" and " + std::to_string(f.other)).c_str() : "", f.what, f.value, f.limit,
                  f.time, f.ratio);
    text += line;
  }
  return text;
}

}  // namespace seine::deceive
