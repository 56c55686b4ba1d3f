// seine plot: a picture of a task, or of a plan for it.
#include <memory>
#include <string>

#include "apps/seine/command.hpp"
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
  expect_writable(arguments.output);
  const world::Scenario scenario = arguments.scenario.load();
  const io::SvgOptions options{.whole = arguments.whole, .title = {}, .note = {}};
  if (arguments.plan.empty()) {
    io::write_svg(scenario, arguments.output, options);
    return kDone;
  }
  const io::PlanFile plan = io::load_plan(arguments.plan);
  io::expect_same_team(scenario, plan, arguments.plan);
  io::write_svg(scenario, plan.plan, arguments.output, options);
  return kDone;
}

}  // namespace

void add_plot(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("plot", "draws a plan as SVG");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("PLAN", arguments->plan, "plan.json");
  command.add_option("-o,--output", arguments->output, "the picture, *.svg")->required();
  command.add_flag("--whole", arguments->whole, "all of a large map, also where nobody drives");
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
