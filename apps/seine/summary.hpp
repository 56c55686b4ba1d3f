#pragma once

#include <string>

#include "seine/certify/certificate.hpp"
#include "seine/planner/planner.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/world/scenario.hpp"

namespace seine::app {

/// A plan in a few lines for people: verdict, times, costs, where it is closest.
std::string summary(const world::Scenario& scenario, const planner::PlanResult& result);

/// A verdict in a few lines: clearances when it holds, else what is broken, when and by whom.
std::string summary(const world::Scenario& scenario, const certify::Certificate& certificate);

/// How a drive went: verdict, what happened when, how well it was followed.
std::string summary(const world::Scenario& scenario, const sim::SimulationResult& driven);

}  // namespace seine::app
