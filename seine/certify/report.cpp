#include "seine/certify/report.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <tuple>

namespace seine::certify {

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::malformed:
      return "malformed";
    case Kind::start:
      return "start";
    case Kind::goal:
      return "goal";
    case Kind::continuity:
      return "continuity";
    case Kind::rest:
      return "rest";
    case Kind::gear:
      return "gear";
    case Kind::speed:
      return "speed";
    case Kind::reverse_speed:
      return "reverse_speed";
    case Kind::acceleration:
      return "acceleration";
    case Kind::lateral_acceleration:
      return "lateral_acceleration";
    case Kind::curvature:
      return "curvature";
    case Kind::steering_rate:
      return "steering_rate";
    case Kind::robot_clearance:
      return "robot_clearance";
    case Kind::obstacle_clearance:
      return "obstacle_clearance";
    case Kind::moving_obstacle_clearance:
      return "moving_obstacle_clearance";
    case Kind::bounds:
      return "bounds";
    case Kind::net_stretch:
      return "net_stretch";
    case Kind::net_topology:
      return "net_topology";
    case Kind::net_holding:
      return "net_holding";
    case Kind::net_opening:
      return "net_opening";
    case Kind::net_drag:
      return "net_drag";
    case Kind::net_obstacle:
      return "net_obstacle";
    case Kind::target_catch:
      return "catch";
    case Kind::braking:
      return "braking";
    case Kind::carrying:
      return "carrying";
    case Kind::delivery:
      return "delivery";
    case Kind::undecided:
      return "undecided";
  }
  return "unknown";
}

void Episodes::offer(double t0, double t1, double time, double value, double excess) {
  constexpr double kTouching = 1e-9;  // s
  if (episodes_.empty() || t0 > episodes_.back().t1 + kTouching) {
    episodes_.push_back({t0, t1, time, value, excess});
    return;
  }
  Episode& last = episodes_.back();
  last.t1 = std::max(last.t1, t1);
  if (excess > last.excess) last.time = time, last.value = value, last.excess = excess;
}

std::string Context::robot_name(int robot) const {
  const auto index = static_cast<std::size_t>(robot);
  if (index < scenario.robots.size() && !scenario.robots[index].name.empty())
    return scenario.robots[index].name;
  return "robot " + std::to_string(robot + 1);
}

std::string Context::obstacle_name(int obstacle) const {
  const std::string& name = scenario.obstacles[static_cast<std::size_t>(obstacle)].name;
  return name.empty() ? "obstacle " + std::to_string(obstacle + 1) : name;
}

std::string Context::target_name(int target) const {
  return scenario.targets.size() == 1 ? "the target" : "target " + std::to_string(target + 1);
}

double Context::height_of(int obstacle) const {
  return obstacle < 0 ? std::numeric_limits<double>::infinity()
                      : scenario.obstacles[static_cast<std::size_t>(obstacle)].height;
}

std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::pair<std::string, std::string> told_apart(double value, double limit) {
  constexpr int kFewest = 4, kMost = 17;
  std::string a, b;
  for (int digits = kFewest; digits <= kMost && a == b; ++digits) {
    a = format("%.*g", digits, value);
    b = format("%.*g", digits, limit);
  }
  return {a, b};
}

std::vector<Violation> worst_of_each(std::vector<Finding> findings, int per_sort) {
  const auto sort_of = [](const Finding& f) {
    return std::tuple(f.violation.kind, f.violation.robot, f.violation.other);
  };
  std::stable_sort(findings.begin(), findings.end(), [&](const Finding& a, const Finding& b) {
    return sort_of(a) != sort_of(b) ? sort_of(a) < sort_of(b) : a.excess > b.excess;
  });
  std::vector<Violation> kept;
  int same = 0;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    same = i > 0 && sort_of(findings[i]) == sort_of(findings[i - 1]) ? same + 1 : 0;
    if (same < std::max(1, per_sort)) kept.push_back(findings[i].violation);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Violation& a, const Violation& b) { return a.time < b.time; });
  return kept;
}

}  // namespace seine::certify
