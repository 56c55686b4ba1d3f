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

constexpr double kFarApart = 0.99;  // m: the simulation does not look further

std::string verdict(const sim::SimulationResult& driven) {
  if (driven.done()) return driven.outcomes.empty() ? "ARRIVED" : "DELIVERED";
  if (driven.outcomes.empty()) return driven.delivered ? "ARRIVED, DAMAGED" : "NOT ARRIVED";
  if (driven.delivered) return "DELIVERED, DAMAGED";
  return driven.caught ? "CAUGHT, NOT DELIVERED" : "NOT CAUGHT";
}

/// What happened when; of many alike the first ones.
std::string events(const sim::SimulationResult& driven) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t i = 0; i < driven.notes.size() && i < kShown; ++i)
    text += printed("  %6.2f s       ", driven.notes[i].time) + driven.notes[i].text + "\n";
  if (driven.notes.size() > kShown) text += printed("  and %zu more\n", driven.notes.size() - kShown);
  return text;
}

/// What a published method says of its own plan; empty for ours.
std::string claim(const planner::PlanResult& result) {
  if (!result.claimed) return {};
  const planner::Quality& quality = result.quality;
  return "  the method     " +
         (*result.claimed ? printed("claims success: arrived after %.2f s, %.1f m driven", quality.makespan,
                                    quality.distance)
                          : std::string("does not claim success")) +
         "\n";
}

}  // namespace

std::string summary(const world::Scenario& scenario, const planner::PlanResult& result) {
  const planner::Times& times = result.times;
  const std::string spent =
      printed("  planned in     %.3f s  guess %.3f, optimise %.3f, certify %.3f\n", times.compute,
              times.guess, times.corridor + times.optimise, times.certify);
  if (!result.certified) {
    return "NO PLAN for " + scenario.name + ", " + team(scenario) + ": " + result.reason + "\n" +
           claim(result) + spent;
  }
  const planner::Quality& quality = result.quality;
  return "CERTIFIED  " + scenario.name + ", " + team(scenario) + "\n" +
         printed("  all arrived    %.2f s, on average %.2f s\n", quality.makespan, quality.mean_travel) +
         printed("  driven         %.1f m, acceleration cost %.1f\n", quality.distance,
                 quality.acceleration_cost) +
         clearances(scenario, result.certificate) + claim(result) + spent;
}

std::string summary(const world::Scenario& scenario, const certify::Certificate& certificate) {
  const std::string checked = printed("  checked in     %.3f s\n", certificate.seconds);
  if (certificate.holds) {
    return "CERTIFIED  " + scenario.name + ", " + team(scenario) + "\n" + clearances(scenario, certificate) +
           checked;
  }
  constexpr std::size_t kShown = 10;
  // Nothing broken was found, but that nothing is broken was not proved either.
  std::string text = (certificate.verdict() == certify::Verdict::undecided ? "UNDECIDED  " : "REFUTED  ") +
                     scenario.name + ", " + team(scenario) + "\n";
  for (std::size_t i = 0; i < certificate.violations.size() && i < kShown; ++i) {
    text += "  " + certificate.violations[i].text + "\n";
  }
  if (certificate.violations.size() > kShown) {
    text += printed("  and %zu more\n", certificate.violations.size() - kShown);
  }
  return text + checked;
}

std::string summary(const world::Scenario& scenario, const sim::SimulationResult& driven) {
  std::string text =
      verdict(driven) + "  " + scenario.name + ", " + team(scenario) + "\n" + events(driven) +
      printed("  tracking       %.3f m RMS, %.3f m at worst\n", driven.tracking_rms, driven.tracking_worst);
  if (driven.min_clearance < kFarApart) {
    text +=
        driven.min_clearance > 0.0
            ? printed("  closest        %.3f m, cars to each other and to obstacles\n", driven.min_clearance)
            : printed("  collision      %.3f m into each other or into obstacles\n", -driven.min_clearance);
  }
  if (scenario.net)
    text += printed("  net            %.1f %% of its length at most%s\n", 100.0 * driven.worst_stretch,
                    driven.worst_stretch > 1.0 ? ": it would tear" : "");
  if (!driven.delivered && driven.goal_error > 0.0)
    text += printed("  goal           missed by %.2f m\n", driven.goal_error);
  if (driven.replans_asked > 0)
    text += printed("  new plans      %d followed of %d, %d too late\n", driven.replans, driven.replans_asked,
                    driven.replans_late);
  return text + printed("  simulated      %.2f s, %.1f times as fast as real time\n", driven.duration,
                        driven.real_time_factor);
}

}  // namespace seine::app
