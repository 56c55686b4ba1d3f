// seine export: the states of every car, for other programs.
#include "seine/io/export.hpp"

#include <filesystem>
#include <memory>
#include <string>

#include "apps/seine/command.hpp"
#include "apps/seine/output.hpp"
#include "seine/io/plan_file.hpp"

namespace seine::app {
namespace {

struct Arguments {
  ScenarioChoice scenario;
  std::string plan;
  std::string output;
  double rate = 20.0;
};

constexpr const char* kFooter =
    R"(The name of the file decides what is written, evaluated from the trajectory itself at any rate:
  *.csv   robot,t,x,y,heading,speed,acceleration,steering (speed signed: negative backwards)
  *.tum   t x y z qx qy qz qw, one file a car
  *.yaml  a CL-MAPF schedule
Example
  seine export team.yaml plan.json --rate 100 -o states.csv)";

int run(const Arguments& arguments) {
  io::Reading reading;
  const world::Scenario scenario = arguments.scenario.load(reading);
  const io::PlanFile plan = io::load_plan(input_path(arguments.plan), &reading);
  io::expect_same_team(scenario, plan, arguments.plan);
  if (is_stdout(arguments.output)) {
    expect_writable(arguments.output, reading);
    print(io::states_csv(scenario, plan.plan, arguments.rate));
    return kDone;
  }
  for (const std::filesystem::path& file : io::exported_files(scenario, arguments.output))
    expect_writable(file.string(), reading);
  io::export_plan(scenario, plan.plan, arguments.rate, arguments.output);
  return kDone;
}

}  // namespace

void add_export(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("export", "writes the states of every car along a plan");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("PLAN", arguments->plan, "plan.json")->required();
  command.add_option("--rate", arguments->rate, "states a second, Hz")
      ->check(kPositive)
      ->capture_default_str();
  command.add_option("-o,--output", arguments->output, "*.csv, *.tum or *.yaml; -: CSV on stdout")
      ->check(kNamed)
      ->required();
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
