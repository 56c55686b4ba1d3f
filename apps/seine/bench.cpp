// seine bench: many scenarios, one CSV, one table.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/seine/bench_rows.hpp"
#include "apps/seine/bench_table.hpp"
#include "apps/seine/command.hpp"
#include "apps/seine/everyday_table.hpp"
#include "apps/seine/output.hpp"
#include "apps/seine/progress_line.hpp"
#include "seine/base/deadline.hpp"
#include "seine/base/error.hpp"
#include "seine/io/map_file.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/planner/planner.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"
#include "seine/world/families.hpp"

namespace seine::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> scenarios;
  std::vector<std::string> families;
  std::vector<std::string> maps;
  std::vector<std::string> kinds, vehicles;  // of --family everyday; none given: all
  std::vector<int> robots{8};
  int seeds = 10;
  int limit = std::numeric_limits<int>::max();
  double deadline = 20.0;
  int threads = 0;
  bool alone = false;
  int best_of = 0;
  std::string reference;
  std::string output;
};

constexpr const char* kFooter =
    R"(Every instance becomes a line of the CSV file; a run that was interrupted goes on where it stopped.
Examples
  seine bench my-tasks/ -o results.csv                              all *.yaml and *.csv in a folder
  seine bench --family random --robots 8 14 20 26 --seeds 50        generated tasks
  seine bench --family everyday --kind parallel garage --seeds 20   what drivers do, with every vehicle
  seine bench --map office.yaml lab.yaml --robots 4 --seeds 5       teams in real buildings)";

/// An instance that can be made when its turn comes.
struct Instance {
  std::string group;
  std::string name;
  std::function<world::Scenario()> load;
};

/// The output may lie in such a folder, but is no task.
void add_files(const std::string& path, const std::string& output, io::Reading& reading,
               std::vector<Instance>& instances) {
  const std::optional<io::FileId> results = io::file_id(output);
  std::vector<fs::path> files;
  if (!fs::exists(path)) throw InputError(path + ": no such file or folder");
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::directory_iterator(path)) {
      const std::string extension = entry.path().extension().string();
      std::error_code broken;  // a link that leads nowhere is no task
      if (entry.is_regular_file(broken) && (extension == ".yaml" || extension == ".csv") &&
          (!results || io::file_id(entry.path()) != results))
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  } else {
    files.emplace_back(path);
  }
  for (const fs::path& file : files) {
    reading.add_file(file);
    const fs::path folder = fs::absolute(file).parent_path();
    const std::string group = (folder.parent_path().filename() / folder.filename()).generic_string();
    instances.push_back({group, file.filename().string(), [file] { return io::load_scenario(file); }});
  }
}

/// Groups are kinds; an instance is named after its vehicle and seed.
void add_everyday(const Arguments& arguments, std::vector<Instance>& instances) {
  std::vector<world::Everyday> kinds;
  for (const std::string& name : arguments.kinds) {
    const std::optional<world::Everyday> kind = world::everyday_named(name);
    if (!kind) throw InputError("bench: there is no everyday kind '" + name + "'" + everyday_kinds(name));
    kinds.push_back(*kind);
  }
  if (kinds.empty()) kinds.assign(world::all_everyday().begin(), world::all_everyday().end());
  std::vector<std::string> vehicles = arguments.vehicles;
  if (vehicles.empty())
    for (const vehicle::CatalogueEntry& entry : vehicle::catalogue()) vehicles.push_back(entry.model.name);
  for (const world::Everyday kind : kinds) {
    for (const std::string& name : vehicles) {
      const vehicle::Model* model = vehicle::catalogued(name);
      if (model == nullptr)
        throw InputError("bench: there is no vehicle '" + name + "'" + vehicles_like(name));
      for (int seed = 0; seed < arguments.seeds; ++seed)
        instances.push_back({world::name_of(kind), name + " " + std::to_string(seed), [=] {
                               return world::everyday(kind, *model, static_cast<std::uint64_t>(seed));
                             }});
    }
  }
}

void add_generated(const Arguments& arguments, io::Reading& reading, std::vector<Instance>& instances) {
  for (const std::string& name : arguments.families) {
    if (name == "everyday") {
      add_everyday(arguments, instances);
      continue;
    }
    const std::optional<world::Family> family = world::family_named(name);
    if (!family)
      throw InputError("bench: there is no family '" + name + "'" +
                       suggested(name, {"random", "swap", "corridor", "parking", "everyday"}));
    for (const int robots : arguments.robots) {
      for (int seed = 0; seed < arguments.seeds; ++seed) {
        instances.push_back({name + "-" + std::to_string(robots), "seed " + std::to_string(seed), [=] {
                               return world::generate(*family, robots, static_cast<std::uint64_t>(seed));
                             }});
      }
    }
  }
  for (const std::string& map : arguments.maps) {
    const auto grid = std::make_shared<const geom::OccupancyGrid>(io::load_map(map, &reading));
    for (const int robots : arguments.robots) {
      const std::string group = fs::path(map).stem().string() + "-" + std::to_string(robots);
      for (int seed = 0; seed < arguments.seeds; ++seed) {
        instances.push_back({group, "seed " + std::to_string(seed),
                             [=] { return world::on_map(*grid, robots, static_cast<std::uint64_t>(seed)); }});
      }
    }
  }
}

std::vector<Instance> instances_of(const Arguments& arguments, io::Reading& reading) {
  std::vector<Instance> all, chosen;
  for (const std::string& path : arguments.scenarios) add_files(path, arguments.output, reading, all);
  add_generated(arguments, reading, all);
  std::map<std::string, int> in_group;
  for (Instance& instance : all) {
    if (in_group[instance.group]++ < arguments.limit) chosen.push_back(std::move(instance));
  }
  if (chosen.empty()) throw InputError("bench: nothing to do, give scenario files, --family or --map");
  return chosen;
}

/// Mean arrival time when every car has the world to itself; NaN when one of them finds no way.
double travel_alone(const world::Scenario& scenario, const planner::Options& options) {
  double sum = 0.0;
  world::Scenario single = scenario;
  for (const world::Robot& robot : scenario.robots) {
    single.robots = {robot};
    const planner::PlanResult result = planner::plan(single, options);
    if (!result.certified) return Row::kNone;
    sum += result.quality.mean_travel;
  }
  return sum / static_cast<double>(scenario.robots.size());
}

/// Shortest makespan of the plans for seeds 1 … `runs`; NaN when none of them is certified.
double best_makespan(const world::Scenario& scenario, planner::Options options, int runs) {
  double best = Row::kNone;
  for (int seed = 1; seed <= runs; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const planner::PlanResult result = planner::plan(scenario, options);
    if (result.certified) best = std::fmin(best, result.quality.makespan);
  }
  return best;
}

void fill(Row& row, const planner::PlanResult& result) {
  row.status = result.certified ? "certified" : result.impossible ? "impossible" : "no";
  row.reason = result.reason;
  row.compute = result.times.compute;
  row.guess = result.times.guess;
  row.corridor = result.times.corridor;
  row.optimise = result.times.optimise;
  row.certify = result.times.certify;
  row.iterations = result.iterations;
  row.repairs = result.repairs;
  if (!result.certified) return;
  row.makespan = result.quality.makespan;
  row.mean_travel = result.quality.mean_travel;
  row.distance = result.quality.distance;
  row.acceleration_cost = result.quality.acceleration_cost;
  row.gear_changes = result.quality.gear_changes;
  row.robot_clearance = result.certificate.robots.clearance;
  row.obstacle_clearance = result.certificate.obstacles.clearance;
}

Row measure(const Instance& instance, const Arguments& arguments) {
  Row row;
  row.group = instance.group;
  row.instance = instance.name;
  Stopwatch planning;
  try {
    const world::Scenario scenario = instance.load();
    row.robots = static_cast<double>(scenario.robots.size());
    planning = Stopwatch();
    const planner::Options options{
        .deadline_s = arguments.deadline, .threads = arguments.threads, .progress = {}};
    fill(row, planner::plan(scenario, options));
    if (arguments.best_of > 0 && row.status == "certified")
      row.best_makespan = std::fmin(row.makespan, best_makespan(scenario, options, arguments.best_of));
    if (arguments.alone && row.status == "certified") row.alone = travel_alone(scenario, options);
  } catch (const InputError& error) {
    row.status = "refused";
    row.reason = error.what();
    row.compute = planning.seconds();
  }
  return row;
}

int run(const Arguments& arguments) {
  io::Reading reading;
  const std::vector<Row> reference = read_reference(arguments.reference);
  reading.add_file(arguments.reference);
  const std::vector<Instance> instances = instances_of(arguments, reading);
  expect_writable(arguments.output, reading);
  RowFile file(arguments.output,
               std::string("seine ") + SEINE_VERSION + " deadline " + std::to_string(arguments.deadline) +
                   " s threads " + std::to_string(arguments.threads) + (arguments.alone ? " alone" : "") +
                   (arguments.best_of > 0 ? " best of " + std::to_string(arguments.best_of) : ""));
  ProgressLine line;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    line.update(instances[i].group + " " + instances[i].name,
                static_cast<double>(i) / static_cast<double>(instances.size()));
    file.refresh();
    if (!file.has(instances[i].group, instances[i].name)) file.append(measure(instances[i], arguments));
  }
  file.refresh();
  line.clear();
  const bool everyday = arguments.families == std::vector<std::string>{"everyday"};
  tell(everyday ? everyday_table(file.rows()) : table(file.rows(), reference), arguments.output);
  return kDone;
}

}  // namespace

void add_bench(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("bench", "plans many tasks: a CSV file and a table");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("SCENARIOS", arguments->scenarios, "files, or folders of them");
  command.add_option("--family", arguments->families, "random, swap, corridor, parking, everyday");
  command.add_option("--kind", arguments->kinds, "everyday: kinds (default: all)");
  command.add_option("--vehicle", arguments->vehicles, "everyday: vehicles (default: all)");
  command.add_option("--map", arguments->maps, "maps to place teams on");
  command.add_option("--robots", arguments->robots, "team sizes for --family and --map")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  command.add_option("--seeds", arguments->seeds, "instances of each, seeds 0, 1, ...")
      ->check(whole_number(1, 1000000))
      ->capture_default_str();
  command.add_option("--limit", arguments->limit, "at most so many instances of a group")
      ->check(whole_number(1, std::numeric_limits<int>::max()));
  command.add_option("--deadline", arguments->deadline, "seconds for each plan")
      ->check(kPositive)
      ->capture_default_str();
  add_threads(command, arguments->threads);
  command.add_flag("--alone", arguments->alone, "also plan every car alone, and compare the travel times");
  command
      .add_option("--best-of", arguments->best_of,
                  "also plan with so many other seeds, and compare with the shortest plan")
      ->check(whole_number(0, 1000));
  command.add_option("--reference", arguments->reference,
                     "CSV of published numbers to show beside the groups");
  command
      .add_option("-o,--output", arguments->output,
                  "CSV file; what it has already is not done again; -: stdout")
      ->check(kNamed);
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
