#include "apps/seine/summary.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace seine::app {
namespace {

[[gnu::format(printf, 1, 2)]] std::string printed(const char* pattern, ...) {
  std::array<char, 512> text{};
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, values);
  va_end(values);
  return text.data();
}

std::string team(const world::Scenario& scenario) {
  const std::size_t count = scenario.robots.size();
  return std::to_string(count) + (count == 1 ? " car" : " cars");
}

std::string name(const world::Scenario& scenario, int robot) {
  const auto index = static_cast<std::size_t>(robot);
  return robot >= 0 && index < scenario.robots.size() ? scenario.robots[index].name : "?";
}

/// Every catch, and how high the net stays; empty for a team without a net.
std::string nets(const certify::Certificate& certificate) {
  std::string text;
  for (const net::Catch& c : certificate.catches) {
    text +=
        printed("  catch          at %.2f s, %.2f m inside the rim beyond radius and error, at %.1f m/s\n",
                c.time, c.rim_margin, c.speed);
  }
  const certify::Closest& ground = certificate.net.ground;
  if (std::isfinite(ground.clearance))
    text += printed("  net            at its lowest %.2f m above what it must clear, at %.2f s\n",
                    ground.clearance, ground.time);
  return text;
}

/// Where the plan is closest; empty for a lone car in the open.
std::string clearances(const world::Scenario& scenario, const certify::Certificate& certificate) {
  std::string text;
  const certify::Closest& cars = certificate.robots;
  if (std::isfinite(cars.clearance)) {
    text += printed("  closest cars   %.3f m  %s and %s at %.2f s\n", cars.clearance,
                    name(scenario, cars.robot).c_str(), name(scenario, cars.other).c_str(), cars.time);
  }
  const certify::Closest& obstacles = certificate.obstacles;
  if (std::isfinite(obstacles.clearance) && obstacles.robot >= 0) {
    text += printed("  to obstacles   %.3f m  %s at %.2f s\n", obstacles.clearance,
                    name(scenario, obstacles.robot).c_str(), obstacles.time);
  }
  return text + nets(certificate);
}

}  // namespace

std::string summary(const world::Scenario& scenario, const planner::PlanResult& result) {
  const planner::Times& times = result.times;
  const std::string spent =
      printed("  planned in     %.3f s  guess %.3f, optimise %.3f, certify %.3f\n", times.compute,
              times.guess, times.corridor + times.optimise, times.certify);
  if (!result.certified) {
    return "NO PLAN for " + scenario.name + ", " + team(scenario) + ": " + result.reason + "\n" + spent;
  }
  const planner::Quality& quality = result.quality;
  return "CERTIFIED  " + scenario.name + ", " + team(scenario) + "\n" +
         printed("  all arrived    %.2f s, on average %.2f s\n", quality.makespan, quality.mean_travel) +
         printed("  driven         %.1f m, acceleration cost %.1f\n", quality.distance,
                 quality.acceleration_cost) +
         clearances(scenario, result.certificate) + spent;
}

std::string summary(const world::Scenario& scenario, const certify::Certificate& certificate) {
  const std::string checked = printed("  checked in     %.3f s\n", certificate.seconds);
  if (certificate.holds) {
    return "CERTIFIED  " + scenario.name + ", " + team(scenario) + "\n" + clearances(scenario, certificate) +
           checked;
  }
  constexpr std::size_t kShown = 10;
  std::string text = "REFUTED  " + scenario.name + ", " + team(scenario) + "\n";
  for (std::size_t i = 0; i < certificate.violations.size() && i < kShown; ++i) {
    text += "  " + certificate.violations[i].text + "\n";
  }
  if (certificate.violations.size() > kShown) {
    text += printed("  and %zu more\n", certificate.violations.size() - kShown);
  }
  return text + checked;
}

}  // namespace seine::app
