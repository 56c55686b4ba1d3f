// seine plot: a picture of a task, or of a plan for it.
#include <memory>
#include <optional>
#include <string>

#include "apps/seine/command.hpp"
#include "apps/seine/output.hpp"
#include "seine/base/error.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/svg.hpp"

namespace seine::app {
namespace {

struct Arguments {
  ScenarioChoice scenario;
  std::string plan;
  std::string output;
  bool whole = false;
};

constexpr const char* kFooter =
    R"(Shows obstacles, bounds, starts and goals; with a plan also every car's way, its footprint along time and its gear changes.
Examples
  seine plot team.yaml plan.json -o plan.svg
  seine plot team.yaml -o task.svg               the task alone)";

int run(const Arguments& arguments) {
  io::Reading reading;
  const world::Scenario scenario = arguments.scenario.load(reading);
  const io::SvgOptions options{.whole = arguments.whole, .title = {}, .note = {}};
  std::optional<io::PlanFile> plan;
  if (!arguments.plan.empty()) {
    plan = io::load_plan(input_path(arguments.plan), &reading);
    io::expect_same_team(scenario, *plan, arguments.plan);
  }
  expect_writable(arguments.output, reading);
  if (!is_stdout(arguments.output) && !arguments.output.ends_with(".svg"))
    throw InputError(arguments.output + ": has an unknown ending, expected .svg");
  write_output(arguments.output, io::svg_text(scenario, plan ? &plan->plan : nullptr, options));
  return kDone;
}

}  // namespace

void add_plot(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("plot", "draws a plan as SVG");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("PLAN", arguments->plan, "plan.json");
  command.add_option("-o,--output", arguments->output, "the picture, *.svg; -: on stdout")
      ->required()
      ->check(kNamed);
  command.add_flag("--whole", arguments->whole, "all of a large map, also where nobody drives");
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
