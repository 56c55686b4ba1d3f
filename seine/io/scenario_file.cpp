#include "seine/io/scenario_file.hpp"

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_formats.hpp"
#include "seine/io/utf8.hpp"
#include "seine/io/yaml_reader.hpp"

namespace seine::io {

namespace {

constexpr int kDeepestImport = 1;  // a scenario imports a file, which imports nothing

void apply(const ScenarioChanges& changes, world::Scenario& scenario) {
  scenario.margins.robot = changes.robot_margin.value_or(scenario.margins.robot);
  scenario.margins.obstacle = changes.obstacle_margin.value_or(scenario.margins.obstacle);
  if (!changes.model) return;
  scenario.models = {*changes.model};
  for (world::Robot& robot : scenario.robots) robot.model = 0;
}

world::Scenario parse(std::string_view text, const std::string& file, const std::filesystem::path& folder,
                      const ScenarioChanges& changes, Reading* reading, int depth);

/// A scenario around another file: its own margins, car and name (docs/scenario.md).
world::Scenario read_import(const YamlValue& root, const std::filesystem::path& folder,
                            const ScenarioChanges& changes, Reading* reading, int depth) {
  const YamlMap top = root.map({"seine", "name", "import", "models", "margins"});
  expect_version(top);
  const YamlValue import = top.at("import");
  if (depth >= kDeepestImport) import.fail("is in an imported file, expected a file that imports nothing");
  ScenarioChanges inner;
  std::optional<double> leaving;
  if (const auto value = top.find("margins")) {
    const MarginChanges margins = read_margins(*value);
    inner.robot_margin = margins.robot, inner.obstacle_margin = margins.obstacle, leaving = margins.leaving;
  }
  if (const auto value = top.find("models")) {
    const std::vector<vehicle::Model> models = read_models(value);
    if (models.size() != 1)
      value->fail(joined("has ", models.size(), " entries, expected one, for every imported car"));
    inner.model = models.front();
  }
  if (changes.robot_margin) inner.robot_margin = changes.robot_margin;
  if (changes.obstacle_margin) inner.obstacle_margin = changes.obstacle_margin;
  if (changes.model) inner.model = changes.model;
  const std::filesystem::path path = referred_file(import, folder);
  if (reading != nullptr) reading->add_file(path);
  world::Scenario scenario = parse(read_file(path, ScenarioCaps::kFileBytes), path.string(),
                                   path.parent_path(), inner, reading, depth + 1);
  if (leaving) scenario.margins.leaving = leaving;
  if (const auto name = top.find("name")) scenario.name = name->text();
  return scenario;
}

world::Scenario parse(std::string_view text, const std::string& file, const std::filesystem::path& folder,
                      const ScenarioChanges& changes, Reading* reading, int depth) {
  const std::filesystem::path path(file);
  const std::string lines = with_line_ends(without_mark(text));
  text = lines;
  const std::string name = as_utf8(path.stem().string());
  world::Scenario scenario;
  if (path.extension() == ".csv") {
    scenario = read_tpcap(text, file, name);
  } else {
    const YamlValue root = YamlValue::parse(text, file, reading);
    const YamlMap top = root.open_map();
    if (top.has("seine")) {
      if (top.has("import")) return read_import(root, folder, changes, reading, depth);
      scenario = read_native(root, name, folder, reading);
    } else if (top.has("agents") && top.has("map")) {
      scenario = read_clmapf(root, name, changes.model.value_or(vehicle::clmapf_car()), reading);
    } else if (top.has("image")) {
      throw complaint(file, 1,
                      "is a map, expected a scenario; a scenario names a map as 'world: {map: ...}'");
    } else {
      throw complaint(file, 1,
                      "is no scenario, expected 'seine: 1' (or a CL-MAPF instance, or a TPCAP .csv)");
    }
  }
  apply(changes, scenario);
  return scenario;
}

}  // namespace

world::Scenario load_scenario(const std::filesystem::path& path, const ScenarioChanges& changes,
                              Reading* reading) {
  if (reading != nullptr) reading->add_file(path);
  return parse_scenario(read_file(path, ScenarioCaps::kFileBytes), path.string(), path.parent_path(), changes,
                        reading);
}

world::Scenario parse_scenario(std::string_view text, const std::string& file,
                               const std::filesystem::path& folder, const ScenarioChanges& changes,
                               Reading* reading) {
  world::Scenario scenario = parse(text, file, folder, changes, reading, 0);
  const world::Margins& margins = scenario.margins;
  if (reading != nullptr && margins.leaving && *margins.leaving >= margins.obstacle) {
    reading->notes.push_back(joined(file, ": 'leaving' of ", number_text(*margins.leaving),
                                    " m has no effect, expected less than the margin to obstacles of ",
                                    number_text(margins.obstacle), " m"));
  }
  return scenario;
}

vehicle::Model load_model(const std::filesystem::path& path, Reading* reading) {
  if (reading != nullptr) reading->add_file(path);
  const std::string text = read_file(path, ScenarioCaps::kFileBytes);
  return read_model(as_utf8(path.stem().string()),
                    YamlValue::parse(with_line_ends(without_mark(text)), path.string(), reading));
}

}  // namespace seine::io
