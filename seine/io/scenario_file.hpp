#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seine/io/reading.hpp"
#include "seine/world/scenario.hpp"

namespace seine::io {

/// Sizes beyond which a scenario is refused.
struct ScenarioCaps {
  static constexpr std::size_t kFileBytes = std::size_t{16} << 20;
  static constexpr std::size_t kRobots = 1000;
  static constexpr std::size_t kModels = 1000;
  static constexpr std::size_t kObstacles = 10000;
  static constexpr std::size_t kPolygonVertices = 5000;
  static constexpr std::size_t kVertices = 100000;  ///< of all obstacles and motions together
  static constexpr std::size_t kNetCorners = 16;    ///< how it hangs is found by trying sets of corners
  static constexpr std::size_t kTargets = 100;
};

/// What a user sets for a file that says something else or cannot say it: other people's files have neither
/// margins nor cars.
struct ScenarioChanges {
  std::optional<double> robot_margin;     ///< m
  std::optional<double> obstacle_margin;  ///< m
  std::optional<vehicle::Model> model;    ///< for every car
};

/// Reads a scenario: Seine's own format (docs/scenario.md), a CL-MAPF instance [Wen22] or a TPCAP case [Li22]
/// (`*.csv`), recognised by content and name. Throws InputError "file:line: what is wrong, what was
/// expected".
/// @param reading gets what was read and noted on the way, where it is given
world::Scenario load_scenario(const std::filesystem::path& path, const ScenarioChanges& changes = {},
                              Reading* reading = nullptr);

/// The same from text.
/// @param file name for messages; its stem is the default name of the scenario, a `.csv` at its end makes it
/// a TPCAP case
/// @param folder where the paths in it start
world::Scenario parse_scenario(std::string_view text, const std::string& file,
                               const std::filesystem::path& folder, const ScenarioChanges& changes = {},
                               Reading* reading = nullptr);

/// Reads one car model from a YAML file with the keys of an entry of `models` (docs/scenario.md).
vehicle::Model load_model(const std::filesystem::path& path, Reading* reading = nullptr);

/// Writes Seine's own format; load_scenario gives back an equal scenario, bit by bit. A map goes into files
/// beside it
/// (`<stem>-map.yaml`, `<stem>-map.pgm`). Throws InputError when the scenario cannot be expressed or the file
/// cannot be written.
void save_scenario(const world::Scenario& scenario, const std::filesystem::path& path);

/// The files that save_scenario writes: the scenario, and where it has a map that and its picture.
std::vector<std::filesystem::path> saved_files(const world::Scenario& scenario,
                                               const std::filesystem::path& path);

/// The text save_scenario writes.
/// @param map_file what `world: map:` shall name; empty when the scenario has no map
std::string scenario_text(const world::Scenario& scenario, const std::string& map_file = "");

}  // namespace seine::io
