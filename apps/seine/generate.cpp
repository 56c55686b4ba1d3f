// seine generate: random instances by family and seed.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "apps/seine/command.hpp"
#include "apps/seine/output.hpp"
#include "seine/base/error.hpp"
#include "seine/io/map_file.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/everyday.hpp"
#include "seine/world/families.hpp"
#include "seine/world/net_families.hpp"

namespace seine::app {
namespace {

constexpr const char* kFamilies = "random, swap, corridor, parking, throw, gap, map or everyday";

struct Arguments {
  std::string family;
  std::optional<int> robots;  // 8 where it is not given
  std::uint64_t seed = 0;
  std::string obstacles;
  double gap = 0.0;
  std::string map;
  std::string kind, vehicle;
  std::string output;
};

constexpr const char* kFooter = R"(Families
  random    convex clutter in 20 x 20 m, everybody about 10 m to go; beyond 26 cars the world grows at 0.05 cars per m2
  swap      starts on a circle, goals opposite: every straight way leads through one point
  corridor  two rooms joined by a bottleneck two lanes wide, half of the team from either side
  parking   half of the team backs out of slots between parked cars, the other half backs in
  throw     a team of 3 to 8 that holds a net; an object flies 1 to 5 m away, in most tasks ahead; catch it, bring it 5 to 9 m further.
            Hard but not impossible: net, speed and angle of the throw fit each other, time and a passage are left (docs/scenario.md)
  gap       such a team carries a load through a wall with one gap, --gap metres wide
  map       a team somewhere in a real building: --map FILE
  everyday  what a driver does, one car or two: --kind KIND --vehicle VEHICLE
            kinds: open, near, forward-only, slalom, parallel, garage, door, pocket, lot, rolling, moving, pair
            vehicles: small-ackermann, rc-1-10, f1tenth, letter, hunter, golf-cart, forklift, csdo, commonroad-1, commonroad-2, autoware, truck-12m
The same family, robots and seed give the same file on every machine.
Examples
  seine generate random --robots 26 --seed 3 -o team.yaml
  seine generate throw --robots 4 --seed 3 --obstacles dense -o throw.yaml
  seine generate map --map office.yaml --robots 4 -o office-team.yaml)";

/// What a family does not know must not be given.
void expect_own_options(const Arguments& arguments) {
  const std::string& family = arguments.family;
  const auto refuse = [&](const char* option, const char* families) {
    throw InputError("generate " + family + ": " + option + " is for the " + families + " only");
  };
  if (!arguments.map.empty() && family != "map") refuse("--map", "family map");
  if (arguments.gap != 0.0 && family != "gap") refuse("--gap", "family gap");
  if (!arguments.kind.empty() && family != "everyday") refuse("--kind", "family everyday");
  if (arguments.robots && family == "everyday")
    throw InputError(
        "generate everyday: --robots is not for the family everyday, whose kinds say how many cars they "
        "have");
  if (!arguments.vehicle.empty() && family != "everyday") refuse("--vehicle", "family everyday");
  if (!arguments.obstacles.empty() && family != "random" && family != "throw")
    refuse("--obstacles", "families random and throw");
}

int obstacle_count(const std::string& text) {
  const std::optional<long long> count = io::parse_integer(text);
  if (!count || *count < 0 || *count > std::numeric_limits<int>::max())
    throw InputError("generate random: --obstacles is '" + text + "', expected a number, zero or more");
  return static_cast<int>(*count);
}

world::Clutteredness clutteredness(const std::string& text) {
  if (text.empty() || text == "few") return world::Clutteredness::few;
  if (text == "dense") return world::Clutteredness::dense;
  throw InputError("generate throw: --obstacles is '" + text + "', expected few or dense");
}

world::Scenario everyday(const Arguments& arguments) {
  const std::string kind = arguments.kind.empty() ? "open" : arguments.kind;
  const std::string vehicle = arguments.vehicle.empty() ? "letter" : arguments.vehicle;
  const std::optional<world::Everyday> which = world::everyday_named(kind);
  if (!which) throw InputError("generate everyday: there is no kind '" + kind + "'" + everyday_kinds(kind));
  const vehicle::Model* model = vehicle::catalogued(vehicle);
  if (model == nullptr)
    throw InputError("generate everyday: there is no vehicle '" + vehicle + "'" + vehicles_like(vehicle));
  return world::everyday(*which, *model, arguments.seed);
}

world::Scenario make(const Arguments& arguments, io::Reading& reading) {
  const std::string& name = arguments.family;
  const int robots = arguments.robots.value_or(8);
  if (name == "map") {
    if (arguments.map.empty())
      throw InputError("generate map: needs --map FILE, a ROS map_server map or a MovingAI grid");
    return world::on_map(io::load_map(input_path(arguments.map), &reading), robots, arguments.seed);
  }
  if (name == "everyday") return everyday(arguments);
  if (name == "throw") return world::throw_scene(robots, arguments.seed, clutteredness(arguments.obstacles));
  if (name == "gap") {
    return arguments.gap == 0.0 ? world::gap_scene(robots, arguments.seed)
                                : world::gap_scene(robots, arguments.seed, arguments.gap);
  }
  const std::optional<world::Family> family = world::family_named(name);
  if (!family)
    throw InputError(
        "generate: there is no family '" + name + "'" +
        suggested(name, {"random", "swap", "corridor", "parking", "throw", "gap", "map", "everyday"}));
  world::FamilyOptions options;
  if (!arguments.obstacles.empty()) options.obstacles = obstacle_count(arguments.obstacles);
  return world::generate(*family, robots, arguments.seed, options);
}

int run(const Arguments& arguments) {
  expect_own_options(arguments);
  expect_writable(arguments.output, {});
  io::Reading reading;
  const world::Scenario scenario = make(arguments, reading);
  if (arguments.output.empty() || is_stdout(arguments.output)) {
    if (scenario.map) throw InputError("generate map: needs -o FILE, the map goes beside it");
    print(io::scenario_text(scenario));
    return kDone;
  }
  for (const std::filesystem::path& file : io::saved_files(scenario, arguments.output))
    expect_writable(file.string(), reading);
  io::save_scenario(scenario, arguments.output);
  return kDone;
}

}  // namespace

void add_generate(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("generate", "makes a random task of a given kind");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("FAMILY", arguments->family, kFamilies)->required();
  command.add_option("--robots", arguments->robots, "how many cars (default: 8); not for everyday")
      ->check(whole_number(1, 1000000));
  add_seed(command, arguments->seed, "which of the instances");
  command.add_option(
      "--obstacles", arguments->obstacles,
      "random: how many (default: 1 per 20 m2); throw: few (0 to 8, the default) or dense (10 to 22)");
  command.add_option("--gap", arguments->gap, "gap: its width in metres (default: 2.6)")->check(kPositive);
  command.add_option("--map", arguments->map, "the map for the family map");
  command.add_option("--kind", arguments->kind, "everyday: which kind (default: open)");
  command.add_option("--vehicle", arguments->vehicle, "everyday: which vehicle (default: letter)");
  command
      .add_option("-o,--output", arguments->output,
                  "file to write (default, or -: stdout); for a map NAME-map.yaml and NAME-map.pgm beside it")
      ->check(kNamed);
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
