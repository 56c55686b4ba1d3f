#include "seine/certify/joints.hpp"

#include <algorithm>
#include <cmath>

namespace seine::certify {

Joints::Joints(const Context& context, int robot) : context_(context), robot_(robot) {
  const vehicle::Model& model =
      context.scenario.model_of(context.scenario.robots[static_cast<std::size_t>(robot)]);
  wheelbase_ = model.wheelbase;
  steering_rate_ = model.limits.steering_rate;
  granted_ = granted_to(model);
  position_ = {.granted = granted_.jump_position, .what = "position", .unit = "m"};
  heading_ = {.granted = granted_.jump_heading, .what = "heading", .unit = "rad"};
  speed_ = {.granted = granted_.jump_speed, .what = "speed", .unit = "m/s"};
  curvature_ = {.granted = granted_.jump_curvature, .what = "curvature", .unit = "1/m"};
}

void Joints::Sum::add(double jump, double at, const char* place) {
  total += jump;  // NaN stays
  if (jump <= largest) return;
  largest = jump, time = at, where = place;
}

void Joints::join_places(const Side& a, const Side& b, double time, const char* where) {
  position_.add(geom::norm(a.frame.position - b.frame.position), time, where);
  const double turned =
      std::atan2(geom::cross(a.frame.forward, b.frame.forward), geom::dot(a.frame.forward, b.frame.forward));
  heading_.add(std::abs(turned), time, where);
}

void Joints::join(const Side& a, const Side& b, double time, const char* where) {
  join_places(a, b, time, where);
  speed_.add(std::abs(a.speed - b.speed), time, where);
  curvature_.add(std::abs(a.curvature - b.curvature), time, where);
}

void Joints::join_segments(const Side& a, const Side& b, double time, bool stops, double wait) {
  constexpr const char* kWhere = "between segments";
  join_places(a, b, time, kWhere);
  const double fastest = std::max(std::abs(a.speed), std::abs(b.speed));
  const bool at_rest = fastest <= granted_.rest;
  if (!stops) {
    speed_.add(std::abs(a.speed - b.speed), time, kWhere);
  } else if (at_rest) {
    speed_.add(std::abs(a.speed) + std::abs(b.speed), time, kWhere);
  } else {
    const auto [value, limit] = told_apart(fastest, granted_.rest);
    rests_.push_back(
        {{Kind::rest, time, robot_, -1, fastest, granted_.rest,
          format("%s: the speed (m/s) where it has to be at rest at t = %.4f s is %s; %s is allowed",
                 context_.robot_name(robot_).c_str(), time, value.c_str(), limit.c_str())},
         fastest - granted_.rest});
  }
  // The front wheel may be turned at rest where there is time for it; what is too much counts.
  const double jump = std::abs(a.curvature - b.curvature);
  if (!at_rest) return curvature_.add(jump, time, kWhere);
  if (std::isinf(steering_rate_)) return;
  const double turn = std::abs(std::atan(wheelbase_ * a.curvature) - std::atan(wheelbase_ * b.curvature));
  const double too_much = turn - steering_rate_ * wait;
  if (!(too_much <= 0.0)) curvature_.add(jump * (too_much / turn), time, kWhere);
}

std::vector<Finding> Joints::findings() const {
  std::vector<Finding> findings = rests_;
  for (const Sum* sum : {&position_, &heading_, &speed_, &curvature_}) {
    if (sum->total <= sum->granted) continue;
    const auto [total, granted] = told_apart(sum->total, sum->granted);
    findings.push_back(
        {{Kind::continuity, sum->time, robot_, -1, sum->total, sum->granted,
          format(
              "%s: its %s jumps by %s %s in all, most (%.3g) at t = %.4f s %s; %s is allowed over the plan",
              context_.robot_name(robot_).c_str(), sum->what, total.c_str(), sum->unit, sum->largest,
              sum->time, sum->where, granted.c_str())},
         std::isfinite(sum->total) ? sum->total - sum->granted : 1e9});
  }
  return findings;
}

}  // namespace seine::certify
