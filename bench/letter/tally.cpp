#include "bench/letter/tally.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace seine::bench {
namespace {

using certify::Kind;

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The speeds at starts, stops and gear changes, which the letter's form cannot bring to zero.
bool is_rest(Kind kind) {
  return kind == Kind::start || kind == Kind::rest;
}

bool is_motion(Kind kind) {
  return kind == Kind::speed || kind == Kind::reverse_speed || kind == Kind::acceleration ||
         kind == Kind::lateral_acceleration || kind == Kind::curvature || kind == Kind::steering_rate;
}

bool is_distance(Kind kind) {
  return kind == Kind::robot_clearance || kind == Kind::obstacle_clearance || kind == Kind::bounds ||
         kind == Kind::net_stretch || kind == Kind::net_topology || kind == Kind::delivery;
}

}  // namespace

// Rests aside, nothing broken by more than the method grants its own samples.
bool Tally::within(const certify::Certificate& certificate) const {
  return std::ranges::all_of(certificate.violations, [this](const certify::Violation& v) {
    if (is_motion(v.kind)) return std::abs(v.value) <= (1.0 + patience_.claim_relative) * std::abs(v.limit);
    if (is_distance(v.kind)) return std::abs(v.value - v.limit) <= patience_.claim_distance;
    return is_rest(v.kind);
  });
}

void Tally::add(const planner::PlanResult& result, double seconds) {
  ++asked_;
  const bool stands_by = result.claimed.value_or(result.certified);
  claimed_ += stands_by;
  certified_ += result.certified;
  compute_.push_back(seconds);
  evaluations_.push_back(result.iterations);
  for (const net::Catch& c : result.certificate.catches) {
    rim_margin_.push_back(c.rim_margin);
    opening_.push_back(c.opening);
  }
  if (!stands_by) return;
  within_ += within(result.certificate);
  ++counted_;
  sum_.makespan += result.quality.makespan;
  sum_.mean_travel += result.quality.mean_travel;
  sum_.distance += result.quality.distance;
  sum_.acceleration_cost += result.quality.acceleration_cost;
  std::set<Kind> kinds;
  for (const certify::Violation& v : result.certificate.violations) kinds.insert(v.kind);
  for (const Kind kind : kinds) ++broken_[kind];
}

void Tally::print_head() {
  std::printf(
      "%-26s tasks claimed within certified  CPU s           evaluations  travel s         dist. m   accel.\n"
      "%-26s                                  median    max    median     mean  longest             cost\n",
      "", "");
}

void Tally::print(const std::string& name) const {
  const double n = counted_ > 0 ? counted_ : std::nan("");
  std::printf("%-26s %5d %7d %6d %9d  %6.3f %6.3f  %8.0f   %7.2f  %7.2f  %8.1f %8.1f\n", name.c_str(), asked_,
              claimed_, within_, certified_, median(compute_), *std::ranges::max_element(compute_),
              median(evaluations_), sum_.mean_travel / n, sum_.makespan / n, sum_.distance / n,
              sum_.acceleration_cost / n);
  std::fflush(stdout);
}

void Tally::print_catches() const {
  if (rim_margin_.empty()) return;
  std::printf("    rim margin %.3f m (median), opening %.3f\n", median(rim_margin_), median(opening_));
}

void Tally::print_broken() const {
  if (broken_.empty()) return;
  std::printf("    the certificate finds broken, in so many of the claimed plans:");
  for (const auto& [kind, count] : broken_) std::printf(" %s %d", certify::name_of(kind), count);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace seine::bench
