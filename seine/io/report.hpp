#pragma once

#include <optional>
#include <string>
#include <vector>

#include "seine/certify/certificate.hpp"
#include "seine/planner/planner.hpp"
#include "seine/sim/simulation.hpp"
#include "seine/world/scenario.hpp"

// What `--json` prints: one JSON object and a line end.
namespace seine::io {

/// The outcome of planning. Keys without a meaning are left out: costs without a
/// certified plan, clearances that are beyond what the certificate looks at.
std::string report_json(const world::Scenario& scenario, const planner::PlanResult& result);

/// The same and how it went when the plan was driven: caught (of targets and payloads), delivered,
/// tracking_rms_m, replans, real_time_factor, and more (docs/simulation.md). What planning took is left out
/// for a plan that was read from a file (`times.compute` 0).
std::string report_json(const world::Scenario& scenario, const planner::PlanResult& result,
                        const sim::SimulationResult& driven);

/// A verdict on a plan made elsewhere: certified, reason, robots, certify_s, clearances, violations, and
/// whether it was made for this scenario.
/// @param changed in what the scenario differs from the one that the plan was made for, as from
/// `changed_since`
std::string report_json(const world::Scenario& scenario, const certify::Certificate& certificate,
                        const std::optional<std::vector<std::string>>& changed = std::nullopt);

/// {"error": message}: wrong input, nothing done.
std::string failure_json(const std::string& message);

}  // namespace seine::io
