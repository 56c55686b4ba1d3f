// seine simulate: a certified plan, driven.
#include "seine/sim/simulation.hpp"

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/seine/command.hpp"
#include "apps/seine/faults.hpp"
#include "apps/seine/output.hpp"
#include "apps/seine/progress_line.hpp"
#include "apps/seine/summary.hpp"
#include "seine/base/error.hpp"
#include "seine/drive/replanner.hpp"
#include "seine/drive/tracking.hpp"
#include "seine/io/plan_file.hpp"
#include "seine/io/report.hpp"
#include "seine/planner/planner.hpp"
#include "seine/sim/csv_log.hpp"
#include "seine/sim/mcap_log.hpp"
#include "seine/world/static_map.hpp"

namespace seine::app {
namespace {

struct Arguments {
  ScenarioChoice scenario;
  std::string plan;
  std::string noise = "none";
  bool replan = false;
  std::uint64_t seed = 0;
  std::vector<std::string> faults;
  std::string log;
  double deadline = std::numeric_limits<double>::infinity();
  int threads = 0;
};

constexpr const char* kFooter =
    R"(The cars follow the plan with model predictive control, through delay, slip and errors of what they know; net and objects
are simulated as bodies. "Caught" is what happened: at rest in the net within 2.5 s of the rim. Only certified plans are driven:
without plan.json it is planned first, and a plan.json is proved first. Exit status 0: everything that was asked for
happened; 1: it did not, or there is no certified plan; 3: the plan.json given could not be proved in time.
Noise
  none   ideal cars and sensors       low   a laboratory with motion capture
  high   cars that find their way with their own sensors
)";

constexpr const char* kExamples = R"(
Examples
  seine simulate throw.yaml --noise low --replan
  seine simulate throw.yaml plan.json --noise high --seed 3 --log drive.mcap     to be looked at in Foxglove
  seine simulate throw.yaml --replan --fault lost-fix:car1@0.5 --fault target-jump@0.8=0.4,0,0)";

/// A log into memory, written when the drive is over.
class Log {
 public:
  explicit Log(std::string path) : path_(std::move(path)) {
    if (path_.empty()) return;
    if (is_stdout(path_)) {
      recorder_ = std::make_unique<sim::CsvLog>(text_);
      return;
    }
    const std::filesystem::path extension = std::filesystem::path(path_).extension();
    if (extension == ".csv") {
      recorder_ = std::make_unique<sim::CsvLog>(text_);
    } else if (extension == ".mcap") {
      recorder_ = std::make_unique<sim::McapLog>(text_);
    } else {
      throw InputError("--log " + path_ + ": expected a name that ends with .csv or .mcap");
    }
  }
  sim::Recorder* recorder() const { return recorder_.get(); }
  void write() const {
    if (recorder_) write_output(path_, text_.view());
  }

 private:
  std::string path_;
  std::ostringstream text_;
  std::unique_ptr<sim::Recorder> recorder_;
};

planner::PlanResult make_plan(const Arguments& arguments, const world::Scenario& scenario,
                              ProgressLine& line) {
  planner::Options options{
      .deadline_s = arguments.deadline, .threads = arguments.threads, .seed = arguments.seed, .progress = {}};
  options.progress = [&line](const planner::Progress& progress) {
    line.update(progress.stage, progress.fraction);
  };
  return planner::plan(scenario, options);
}

/// A plan from a file, proved anew.
planner::PlanResult prove_plan(const Arguments& arguments, const world::Scenario& scenario,
                               io::PlanFile file) {
  const world::StaticMap map(scenario);
  planner::PlanResult result{.plan = std::move(file.plan)};
  result.certificate = certify::certify(
      scenario, map, result.plan, {.threads = arguments.threads, .deadline = Deadline(arguments.deadline)});
  result.certified = result.certificate.holds;
  result.reason = result.certified ? "" : result.certificate.violations.front().text;
  result.quality = planner::measure(result.plan);
  result.times.certify = result.certificate.seconds;
  return result;
}

sim::SimulationResult drive_plan(const Arguments& arguments, const world::Scenario& scenario,
                                 const traj::TeamTrajectory& plan, sim::Recorder* recorder,
                                 ProgressLine& line) {
  sim::SimulationOptions options{.noise = sim::noise_named(arguments.noise),
                                 .seed = arguments.seed,
                                 .faults = parse_faults(arguments.faults, scenario),
                                 .recorder = recorder};
  if (arguments.replan) options.replanner = drive::replanner({.seed = arguments.seed});
  options.progress = [&line](double part) { line.update("drive", part); };
  return sim::simulate(scenario, plan,
                       drive::tracking_controller(scenario, drive::tracking_options(options.noise)), options);
}

int run(const Arguments& arguments, bool json) {
  const Log log(arguments.log);
  if (json && is_stdout(arguments.log))
    throw InputError("--json and --log " + arguments.log + " both go to stdout, expected one of them");
  io::Reading reading;
  const world::Scenario scenario = arguments.scenario.load(reading);
  std::optional<io::PlanFile> file;
  if (!arguments.plan.empty()) {
    file = io::load_plan(input_path(arguments.plan), &reading);
    io::expect_same_team(scenario, *file, arguments.plan);
  }
  expect_writable(arguments.log, reading);
  parse_faults(arguments.faults, scenario);  // complaints come before the work
  ProgressLine line;
  const planner::PlanResult plan = with_places(reading, [&] {
    return file ? prove_plan(arguments, scenario, std::move(*file)) : make_plan(arguments, scenario, line);
  });
  if (!plan.certified) {
    line.clear();
    if (json) {
      print(io::report_json(scenario, plan));
    } else {
      tell(arguments.plan.empty() ? summary(scenario, plan) : summary(scenario, plan.certificate),
           arguments.log);
    }
    return !arguments.plan.empty() && plan.certificate.verdict() == certify::Verdict::undecided ? kUndecided
                                                                                                : kNo;
  }
  const sim::SimulationResult driven = drive_plan(arguments, scenario, plan.plan, log.recorder(), line);
  line.clear();
  log.write();
  std::string text = json ? io::report_json(scenario, plan, driven) : summary(scenario, driven);
  if (!json && log.recorder() != nullptr && !is_stdout(arguments.log))
    text += "  written to     " + arguments.log + "\n";
  tell(text, arguments.log);
  return driven.done() ? kDone : kNo;
}

}  // namespace

void add_simulate(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("simulate", "drives a certified plan, with noise and physics");
  command.footer(std::string(kFooter) + kFaultHelp + kExamples);
  const auto arguments = std::make_shared<Arguments>();
  add_scenario(command, arguments->scenario);
  command.add_option("PLAN", arguments->plan, "plan.json; without it the task is planned first");
  command.add_option("--noise", arguments->noise, "none, low or high")
      ->check(word_of({"none", "low", "high"}))
      ->capture_default_str();
  command.add_flag("--replan", arguments->replan,
                   "new plans on the way, from where the team is to where the target is seen to fly");
  add_seed(command, arguments->seed, "for what is drawn: noise, and choices of the planner");
  command.add_option("--fault", arguments->faults, "something that goes wrong, see below")
      ->allow_extra_args(false);
  command.add_option("--log", arguments->log, "every signal, *.csv or *.mcap; -: CSV on stdout")
      ->check(kNamed);
  command
      .add_option("--deadline", arguments->deadline,
                  "seconds of wall time for the plan that is made, or for the proof of the one given")
      ->check(kPositive);
  add_threads(command, arguments->threads);
  add_json(command, invocation);
  command.callback([&invocation, arguments] {
    invocation.run = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace seine::app
