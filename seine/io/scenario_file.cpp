#include "seine/io/scenario_file.hpp"

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/scenario_formats.hpp"
#include "seine/io/yaml_reader.hpp"

namespace seine::io {

world::Scenario load_scenario(const std::filesystem::path& path) {
  return parse_scenario(read_file(path, ScenarioCaps::kFileBytes), path.string(), path.parent_path());
}

world::Scenario parse_scenario(std::string_view text, const std::string& file,
                               const std::filesystem::path& folder) {
  const std::filesystem::path path(file);
  const std::string name = path.stem().string();
  if (path.extension() == ".csv") return read_tpcap(text, file, name);
  const YamlValue root = YamlValue::parse(text, file);
  const YamlMap top = root.open_map();
  if (top.has("seine")) return read_native(root, name, folder);
  if (top.has("agents") && top.has("map")) return read_clmapf(root, name);
  if (top.has("image")) {
    throw complaint(file, 1, "is a map, expected a scenario; a scenario names a map as 'world: {map: ...}'");
  }
  throw complaint(file, 1, "is no scenario, expected 'seine: 1' (or a CL-MAPF instance, or a TPCAP .csv)");
}

}  // namespace seine::io
