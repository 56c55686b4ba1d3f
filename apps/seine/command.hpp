#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "seine/world/scenario.hpp"

namespace seine::app {

/// What the program answers to the shell (scripts rely on it).
enum ExitStatus : int {
  kDone = 0,   ///< what was asked for happened; for a plan: it is certified
  kNo = 1,     ///< no: no certified plan, a plan refuted, interrupted
  kWrong = 2,  ///< the input or the command line is wrong
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

/// The scenario of the command line.
struct ScenarioChoice {
  std::string path;
  std::optional<double> robot_margin, obstacle_margin;  ///< m, instead of the file's
  std::string model;                                    ///< a file; empty: the cars of the scenario

  /// Throws InputError.
  world::Scenario load() const;
};

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

/// Throws InputError now when `path` could not be written later: a long computation must not end in that
/// message.
void expect_writable(const std::string& path);

}  // namespace seine::app
