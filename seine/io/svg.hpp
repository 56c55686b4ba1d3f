#pragma once

#include <filesystem>
#include <string>

#include "seine/traj/trajectory.hpp"
#include "seine/world/scenario.hpp"

namespace seine::io {

struct SvgOptions {
  double size = 960.0;  ///< px, the longer side of the drawn area
  double ghost_interval =
      0.0;  ///< s between drawn footprints of a car on its way; 0: a round number that suits the plan
  bool whole = false;  ///< draw all of the bounds, even where the team uses a small part of a large map
  std::string title;   ///< default: the scenario's name
  std::string note;    ///< appended to the line under the title, as in "certified"
};

/// A picture of a scenario and of a plan for it (nullptr: none): obstacles, map, every car's way with its
/// footprints along time.
std::string svg_text(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                     const SvgOptions& options = {});

void write_svg(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
               const std::filesystem::path& path, const SvgOptions& options = {});
void write_svg(const world::Scenario& scenario, const std::filesystem::path& path,
               const SvgOptions& options = {});

}  // namespace seine::io
