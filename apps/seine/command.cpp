#include "apps/seine/command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "seine/base/error.hpp"
#include "seine/io/scenario_file.hpp"

namespace seine::app {

const CLI::Validator kPositive(
    [](std::string& text) -> std::string {
      double value = 0.0;
      if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0) return {};
      return "expected a number above 0, not '" + text + "'";
    },
    "ABOVE 0");

world::Scenario ScenarioChoice::load() const {
  io::ScenarioChanges changes{.robot_margin = robot_margin, .obstacle_margin = obstacle_margin, .model = {}};
  if (!model.empty()) changes.model = io::load_model(model);
  return io::load_scenario(path, changes);
}

void add_scenario(CLI::App& command, ScenarioChoice& choice) {
  command
      .add_option("SCENARIO", choice.path,
                  "the task: a scenario file, a CL-MAPF instance (*.yaml) or a TPCAP case (*.csv)")
      ->required();
  const CLI::Range margin(0.0, 100.0);
  command.add_option("--margin-robot", choice.robot_margin, "m between cars, instead of the file's")
      ->check(margin);
  command
      .add_option("--margin-obstacle", choice.obstacle_margin,
                  "m to obstacles and bounds, instead of the file's")
      ->check(margin);
  command.add_option("--model", choice.model,
                     "a YAML file with footprint, wheelbase and limits: the car that every robot is");
}

void add_threads(CLI::App& command, int& threads) {
  const int most = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command
      .add_option("--threads", threads,
                  "0: as many as the machine has; of more than that only so many are started")
      ->check(CLI::Range(0, 1024))
      ->transform([most](const std::string& text) {
        int asked = 0;
        return CLI::detail::lexical_cast(text, asked) && asked > most ? std::to_string(most) : text;
      })
      ->capture_default_str();
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning) {
  command.add_option("--seed", seed, meaning)->check(CLI::NonNegativeNumber)->capture_default_str();
}

void add_json(CLI::App& command, Invocation& invocation) {
  command.add_flag("--json", invocation.json, "answer with one JSON object on stdout");
}

void expect_writable(const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty()) return;
  std::error_code error;
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (fs::is_directory(path, error))
    throw InputError(path + ": is a folder, expected the name of a file to write");
  if (!fs::is_directory(folder, error)) throw InputError(path + ": there is no folder " + folder.string());
  const fs::path target = fs::exists(path, error) ? fs::path(path) : folder;
  if (::access(target.c_str(), W_OK) != 0) throw InputError(path + ": no permission to write there");
}

}  // namespace seine::app
