// seine certify: proves or refutes any plan.
#include "seine/certify/certificate.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/seine/command.hpp"
#include "apps/seine/output.hpp"
#include "apps/seine/summary.hpp"
#include "seine/base/deadline.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/report.hpp"
#include "seine/world/static_map.hpp"

namespace seine::app {
namespace {

struct Arguments {
  ScenarioChoice scenario;
  std::string plan;
  double deadline = 60.0;
  int threads = 0;
};

constexpr const char* kFooter =
    R"(The proof holds in continuous time, with exact geometry, and knows nothing of how the plan was made: it may have been
edited by hand or come from another program. Exit status 0: every limit is kept; 1: refuted, with the time and the cars;
3: undecided, nothing broken was found but the time did not suffice for the proof.
Example
  seine certify team.yaml plan.json)";

/// A line for a plan that was made for another question: the verdict is on this one all the same.
std::string note_on(const std::optional<std::vector<std::string>>& changed) {
  if (!changed || changed->empty()) return "";
  std::string parts;
  for (const std::string& part : *changed) parts += (parts.empty() ? "" : ", ") + part;
  return "  note           the plan was made for another scenario (different: " + parts +
         "); it is judged by this one\n";
}

int run(const Arguments& arguments, bool json) {
  io::Reading reading;
  const world::Scenario scenario = arguments.scenario.load(reading);
  const io::PlanFile plan = io::load_plan(input_path(arguments.plan), &reading);
  io::expect_same_team(scenario, plan, arguments.plan);
  const world::StaticMap map(scenario);
  const certify::Certificate certificate = certify::certify(
      scenario, map, plan.plan, {.threads = arguments.threads, .deadline = Deadline(arguments.deadline)});
  const std::optional<std::vector<std::string>> changed = io::changed_since(scenario, plan);
  print(json ? io::report_json(scenario, certificate, changed)
             : summary(scenario, certificate) + note_on(changed));
  if (certificate.holds) return kDone;
  return certificate.verdict() == certify::Verdict::undecided ? kUndecided : kNo;
}

}  // namespace

void add_certify(CLI::App& program, Invocation& invocation) {
  CLI::App& command =
      *program.add_subcommand("certify", "proves a plan in continuous time, or says what it breaks");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("PLAN", arguments->plan, "plan.json")->required();
  command.add_option("--deadline", arguments->deadline, "seconds; what is not proved by then is undecided")
      ->check(kPositive)
      ->capture_default_str();
  add_threads(command, arguments->threads);
  add_json(command, invocation);
  command.callback([&invocation, arguments] {
    invocation.run = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace seine::app
