#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "seine/io/yaml_reader.hpp"
#include "seine/world/scenario.hpp"

// The formats behind load_scenario, one function and one source file each.
namespace seine::io {

/// Values beyond these are typing errors, not tasks. Metres, seconds, radians.
inline constexpr Range kCoordinate{-1e6, 1e6};
inline constexpr Range kSize{1e-4, 1e4};
inline constexpr Range kAngle{-1e4, 1e4};

/// Seine's own format (design section 9).
world::Scenario read_native(const YamlValue& root, const std::string& name,
                            const std::filesystem::path& folder);

/// Its keys `net`, `targets`, `payload` and `delivery`; the robots have been read already.
void read_net_keys(const YamlMap& top, world::Scenario& scenario);

/// A CL-MAPF instance [Wen22]: car and obstacle radius built in, yaw clockwise in the file.
world::Scenario read_clmapf(const YamlValue& root, const std::string& name);

/// A TPCAP case [Li22]: one line of comma-separated numbers.
world::Scenario read_tpcap(std::string_view text, const std::string& file, const std::string& name);

}  // namespace seine::io
