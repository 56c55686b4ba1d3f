#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "seine/io/reading.hpp"
#include "seine/io/yaml_reader.hpp"
#include "seine/world/scenario.hpp"

// The formats behind load_scenario, one function and one source file each.
namespace seine::io {

/// Values beyond these are typing errors, not tasks. Metres, seconds, radians. Coordinates of all projections
/// in use fit in: UTM's reach 1e7 m, Web Mercator's 2e7 m.
inline constexpr Range kCoordinate{-1e8, 1e8};
inline constexpr double kWidestWorld = 2e6;  // m
inline constexpr Range kSize{1e-4, 1e4};
inline constexpr Range kMargin{0.0, 100.0};

/// Seine's own format (docs/scenario.md).
world::Scenario read_native(const YamlValue& root, const std::string& name,
                            const std::filesystem::path& folder, Reading* reading);

/// Its keys `seine`, `models` (absent: the one default model), and an entry of `models`.
void expect_version(const YamlMap& top);
std::vector<vehicle::Model> read_models(const std::optional<YamlValue>& value);
/// Its `margins`, m: what the file says.
struct MarginChanges {
  std::optional<double> robot, obstacle, leaving;
};
MarginChanges read_margins(const YamlValue& value);

/// The file a value names, which must be there.
std::filesystem::path referred_file(const YamlValue& value, const std::filesystem::path& folder);
vehicle::Model read_model(const std::string& name, const YamlValue& value);

/// Its keys `net`, `targets`, `payload` and `delivery`; the robots have been read already.
void read_net_keys(const YamlMap& top, world::Scenario& scenario);

/// A CL-MAPF instance [Wen22]: obstacle radius built in, yaw clockwise in the file; its bounds depend on the
/// car.
world::Scenario read_clmapf(const YamlValue& root, const std::string& name, const vehicle::Model& car,
                            Reading* reading);

/// A TPCAP case [Li22]: one line of comma-separated numbers.
world::Scenario read_tpcap(std::string_view text, const std::string& file, const std::string& name);

}  // namespace seine::io
