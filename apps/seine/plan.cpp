// seine plan: from a scenario to a certified plan.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/seine/command.hpp"
#include "apps/seine/interrupt.hpp"
#include "apps/seine/output.hpp"
#include "apps/seine/progress_line.hpp"
#include "apps/seine/summary.hpp"
#include "seine/base/error.hpp"
#include "seine/baseline/letter/letter.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/report.hpp"
#include "seine/planner/planner.hpp"

namespace seine::app {
namespace {

struct Arguments {
  ScenarioChoice scenario;
  std::string output;
  double deadline = std::numeric_limits<double>::infinity();
  int threads = 0;
  std::uint64_t seed = 0;
  std::string method = "joint";
  std::optional<double> cusp_speed;
  std::vector<std::string> without;
};

constexpr const char* kFooter =
    R"(All cars are planned together. What is written has been proved in continuous time; where no such plan was found, nothing
is written and the exit status is 1. Ctrl-C ends it: with -o or --json the best certified plan so far is given out, and the
exit status is 130.
Examples
  seine plan team.yaml -o plan.json
  seine plan team.yaml --deadline 0.5 --json     the best certified plan within half a second, as numbers
  seine plan map_50by50_obst25_agents10_ex0.yaml   a CL-MAPF instance as it is
  seine plan team.yaml --method letter --json    what the method of Pei et al. claims, and what is proved)";

planner::Ablation ablation_of(const std::vector<std::string>& without) {
  const auto has = [&](const char* part) {
    return std::find(without.begin(), without.end(), part) != without.end();
  };
  return {.catching = has("catch"),
          .size = has("size"),
          .topology = has("topology"),
          .relaxation = has("relaxation"),
          .cusps = has("cusps")};
}

planner::PlanResult plan(const world::Scenario& scenario, const Arguments& arguments,
                         const planner::Options& options) {
  if (arguments.method == "joint") return planner::plan(scenario, options);
  baseline::letter::Settings settings;
  settings.cusp_speed = arguments.cusp_speed.value_or(settings.cusp_speed);
  return baseline::letter::plan(scenario, options, settings);
}

std::string told(const world::Scenario& scenario, const planner::PlanResult& result,
                 const Arguments& arguments) {
  std::string text = summary(scenario, result);
  if (result.certified && !arguments.output.empty() && !is_stdout(arguments.output))
    text += "  written to     " + arguments.output + "\n";
  return text;
}

int run(const Arguments& arguments, bool json) {
  if (arguments.cusp_speed && arguments.method != "letter")
    throw InputError("--cusp-speed belongs to --method letter: cars of the method " + arguments.method +
                     " come to rest");
  if (json && is_stdout(arguments.output))
    throw InputError("--json and -o " + arguments.output + " both go to stdout, expected one of them");
  io::Reading reading;
  const world::Scenario scenario = arguments.scenario.load(reading);
  expect_writable(arguments.output, reading);
  ProgressLine line;
  planner::Options options{.deadline_s = arguments.deadline,
                           .threads = arguments.threads,
                           .seed = arguments.seed,
                           .cancelled = nullptr,
                           .without = ablation_of(arguments.without),
                           .progress = {}};
  options.progress = [&line](const planner::Progress& progress) {
    line.update(progress.stage, progress.fraction);
  };
  // Who asked for a plan to keep gets what there is by then.
  if (json || !arguments.output.empty()) options.cancelled = &wind_up_on_interrupt();
  planner::PlanResult result = with_places(reading, [&] { return plan(scenario, arguments, options); });
  line.clear();
  const int interrupted = interrupted_status();
  if (interrupted != 0)
    std::fprintf(stderr, "seine: %s\n", result.certified ? "interrupted" : result.reason.c_str());
  if (result.certified && !arguments.output.empty()) {
    write_output(arguments.output, io::plan_text(scenario, result,
                                                 {.method = arguments.method,
                                                  .seed = arguments.seed,
                                                  .threads = arguments.threads,
                                                  .deadline_s = arguments.deadline}));
  }
  if (json) print(io::report_json(scenario, result));
  if (!json && (result.certified || interrupted == 0))
    tell(told(scenario, result, arguments), arguments.output);
  if (interrupted != 0) return interrupted;
  return result.certified ? kDone : kNo;
}

}  // namespace

void add_plan(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("plan", "plans a team of cars and certifies the plan");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("-o,--output", arguments->output, "where the plan goes, plan.json; -: stdout")
      ->check(kNamed);
  command
      .add_option("--deadline", arguments->deadline,
                  "seconds of wall time; the best certified plan by then (default: no limit)")
      ->check(kPositive);
  add_threads(command, arguments->threads);
  add_seed(command, arguments->seed, "for the choices that are drawn");
  command
      .add_option("--method", arguments->method,
                  "joint: all cars optimised together; letter: the planner of Pei et al. 2024 as printed")
      ->check(word_of({"joint", "letter"}))
      ->capture_default_str();
  command
      .add_option("--cusp-speed", arguments->cusp_speed,
                  "method letter: m/s at starts, stops and gear changes, where it cannot rest (0.24)")
      ->check(kPositive);
  command
      .add_option("--without", arguments->without,
                  "parts of the method to leave out, to see what they bring: catch, size, topology, "
                  "relaxation, cusps (teams with a net; the certificate still asks for everything)")
      ->delimiter(',')
      ->check(word_of({"catch", "size", "topology", "relaxation", "cusps"}));
  add_json(command, invocation);
  command.callback([&invocation, arguments] {
    invocation.run = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace seine::app
