#include "apps/seine/command.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/suggestion.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"

namespace seine::app {

const CLI::Validator kPositive(
    [](std::string& text) -> std::string {
      double value = 0.0;
      if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0) return {};
      return "expected a number above 0, not '" + text + "'";
    },
    "ABOVE 0");

const CLI::Validator kNamed(
    [](std::string& text) -> std::string {
      return text.empty() ? "expected the name of a file, not ''" : "";
    },
    "FILE");

CLI::Validator whole_number(long long low, long long high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        const std::optional<long long> value = io::parse_integer(text);
        if (!value || *value < low || *value > high)
          return "expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                 ", not '" + text + "'";
        text = std::to_string(*value);
        return {};
      },
      "");
}

std::string suggested(const std::string& word, const std::vector<std::string_view>& known) {
  return io::did_you_mean(word, known) + "; expected " + io::one_of(known);
}

std::string everyday_kinds(const std::string& word) {
  std::vector<std::string_view> known;
  for (const world::Everyday kind : world::all_everyday()) known.push_back(world::name_of(kind));
  return suggested(word, known);
}

std::string vehicles_like(const std::string& word) {
  std::vector<std::string_view> known;
  for (const vehicle::CatalogueEntry& entry : vehicle::catalogue()) known.push_back(entry.model.name);
  return suggested(word, known);
}

CLI::Validator word_of(std::vector<std::string> words) {
  return CLI::Validator(
      [words = std::move(words)](std::string& text) -> std::string {
        if (std::ranges::find(words, text) != words.end()) return {};
        const std::vector<std::string_view> known(words.begin(), words.end());
        return "there is no '" + text + "'" + suggested(text, known);
      },
      "");
}

std::string input_path(const std::string& given) {
  return given == "-" ? "/dev/stdin" : given;
}

std::string place_of(const world::Complaint& complaint, const io::Reading& reading) {
  const auto robot = static_cast<std::size_t>(complaint.robot);
  if (complaint.robot < 0 || robot >= reading.robots.size()) return "";
  return complaint.goal ? reading.robots[robot].goal : reading.robots[robot].start;
}

world::Scenario ScenarioChoice::load_quietly(io::Reading& reading) const {
  io::ScenarioChanges changes{.robot_margin = robot_margin, .obstacle_margin = obstacle_margin, .model = {}};
  if (!model.empty()) changes.model = io::load_model(input_path(model), &reading);
  return io::load_scenario(input_path(path), changes, &reading);
}

world::Scenario ScenarioChoice::load(io::Reading& reading) const {
  world::Scenario scenario = load_quietly(reading);
  constexpr std::size_t kShown = 3;
  const std::vector<std::string>& notes = reading.notes;
  for (std::size_t i = 0; i < std::min(notes.size(), kShown); ++i)
    std::fprintf(stderr, "seine: note: %s\n", notes[i].c_str());
  if (notes.size() > kShown)
    std::fprintf(stderr, "seine: note: and %zu more like these\n", notes.size() - kShown);
  return scenario;
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
      ->check(whole_number(0, 1024))
      ->transform([most](const std::string& text) {
        int asked = 0;
        return CLI::detail::lexical_cast(text, asked) && asked > most ? std::to_string(most) : text;
      })
      ->capture_default_str();
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning) {
  const CLI::Validator whole(
      [](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size())
          return "expected a whole number from 0 to 18446744073709551615, not '" + text + "'";
        text = std::to_string(value);
        return {};
      },
      "");
  command.add_option("--seed", seed, meaning)->check(whole)->capture_default_str();
}

void add_json(CLI::App& command, Invocation& invocation) {
  command.add_flag("--json", invocation.json, "answer with one JSON object on stdout");
}

}  // namespace seine::app
