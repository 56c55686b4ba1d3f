#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/io/reading.hpp"
#include "seine/world/check.hpp"
#include "seine/world/scenario.hpp"

namespace seine::app {

/// What the program answers to the shell (scripts rely on it).
enum ExitStatus : int {
  kDone = 0,       ///< what was asked for happened; for a plan: it is certified
  kNo = 1,         ///< no: no certified plan, a plan refuted
  kWrong = 2,      ///< the input or the command line is wrong, or the answer cannot be written
  kUndecided = 3,  ///< neither proved nor refuted within the deadline
  kSignal = 128,   ///< plus the number of the signal that ended it: 130 for Ctrl-C
};

/// What the chosen subcommand will do, and how it answers when something goes wrong on the way.
struct Invocation {
  std::function<int()> run;
  bool json = false;  ///< stdout carries one JSON object and nothing else
};

// Each adds its subcommand to the program; when the user chose it, `invocation.run` holds the work. One
// source file each.
void add_plan(CLI::App& program, Invocation& invocation);
void add_certify(CLI::App& program, Invocation& invocation);
void add_simulate(CLI::App& program, Invocation& invocation);
void add_plot(CLI::App& program, Invocation& invocation);
void add_generate(CLI::App& program, Invocation& invocation);
void add_export(CLI::App& program, Invocation& invocation);
void add_bench(CLI::App& program, Invocation& invocation);
void add_check(CLI::App& program, Invocation& invocation);

/// The scenario of the command line.
struct ScenarioChoice {
  std::string path;
  std::optional<double> robot_margin, obstacle_margin;  ///< m, instead of the file's
  std::string model;                                    ///< a file; empty: the cars of the scenario

  /// Tells on stderr what looks like a slip. Throws InputError.
  /// @param reading gets the files that were read
  world::Scenario load(io::Reading& reading) const;
  /// The same without a word.
  world::Scenario load_quietly(io::Reading& reading) const;
};

/// What the command line calls a file: "-" is the standard input.
std::string input_path(const std::string& given);
/// "file:line" of the start or goal that a complaint is about; empty where that is not known.
std::string place_of(const world::Complaint& complaint, const io::Reading& reading);
/// Does the work; what is wrong with the scenario is then told with the place in its file.
template <class Work>
auto with_places(const io::Reading& reading, Work&& work) {
  try {
    return work();
  } catch (const world::Unsound& unsound) {
    const std::string where = place_of(unsound.complaints().front(), reading);
    throw InputError((where.empty() ? "" : where + ": ") + unsound.what());
  }
}
/// The positional SCENARIO that most subcommands begin with, and the options that change it.
void add_scenario(CLI::App& command, ScenarioChoice& choice);
/// `--threads`, 0 for as many as the machine has.
void add_threads(CLI::App& command, int& threads);
/// `--seed`, 0 … 2^64 − 1.
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning);
/// `--json`.
void add_json(CLI::App& command, Invocation& invocation);
/// Accepts finite numbers above zero, as text.
extern const CLI::Validator kPositive;
/// Accepts any name but none at all: an unset variable must not mean "nowhere".
extern const CLI::Validator kNamed;
/// Accepts whole numbers in decimal from `low` to `high`; what is beyond is refused, not cut off.
CLI::Validator whole_number(long long low, long long high);
/// What to say after a word that is none of these: the nearest, and all.
std::string suggested(const std::string& word, const std::vector<std::string_view>& known);
std::string everyday_kinds(const std::string& word);
std::string vehicles_like(const std::string& word);
/// Accepts these words; the nearest is named for another.
CLI::Validator word_of(std::vector<std::string> words);

}  // namespace seine::app
