#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seine/io/reading.hpp"
#include "seine/planner/planner.hpp"
#include "seine/traj/trajectory.hpp"
#include "seine/world/fingerprint.hpp"
#include "seine/world/scenario.hpp"

namespace seine::io {

/// How a plan was asked for: noted in the file, of no consequence when it is read.
struct PlanSettings {
  std::string method = "joint";
  std::uint64_t seed = 0;
  int threads = 0;                                              ///< 0: as many as the machine has
  double deadline_s = std::numeric_limits<double>::infinity();  ///< wall time
};

/// What a plan file (docs/plan-format.md) says that a reader may rely on: the trajectories. Its certificate
/// and its sampled states are for people and other programs; whoever must know certifies again.
struct PlanFile {
  std::string scenario;                        ///< name
  std::optional<world::Fingerprint> made_for;  ///< of the scenario; older plans do not say
  std::vector<std::string> robots;             ///< names, in the order of plan.robots
  traj::TeamTrajectory plan;
};

/// Throws InputError: with the line for a syntax error, else with the place, as in
/// `robots[2].segments[0].gear`. Numbers may be any finite ones that make a trajectory (docs/plan-format.md);
/// whether it keeps the limits is for the certificate to say.
/// @param reading gets the file, where it is given
PlanFile load_plan(const std::filesystem::path& path, Reading* reading = nullptr);
/// @param file name for messages
PlanFile parse_plan(std::string_view text, const std::string& file);

/// Throws InputError unless the plan is for the scenario's robots: as many, the same names in the same order.
void expect_same_team(const world::Scenario& scenario, const PlanFile& plan, const std::string& file);

/// In what the scenario differs from the one that the plan was made for ("models", "margins", …); empty when
/// in nothing. None when the plan does not say what it was made for.
std::optional<std::vector<std::string>> changed_since(const world::Scenario& scenario, const PlanFile& plan);

/// Writes the file in one go or not at all. Every coefficient reads back as the very same double.
void save_plan(const world::Scenario& scenario, const planner::PlanResult& result,
               const std::filesystem::path& path, const PlanSettings& settings = {});
std::string plan_text(const world::Scenario& scenario, const planner::PlanResult& result,
                      const PlanSettings& settings = {});

}  // namespace seine::io
