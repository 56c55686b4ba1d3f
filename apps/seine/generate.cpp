// seine generate: random instances by family and seed.
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "apps/seine/command.hpp"
#include "seine/base/error.hpp"
#include "seine/io/map_file.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/world/families.hpp"

namespace seine::app {
namespace {

struct Arguments {
  std::string family;
  int robots = 8;
  std::uint64_t seed = 0;
  int obstacles = -1;
  std::string map;
  std::string output;
};

constexpr const char* kFooter = R"(Families
  random    convex clutter in 20 x 20 m, everybody about 10 m to go; beyond 26 cars the world grows at 0.05 cars per m2
  swap      starts on a circle, goals opposite: every straight way leads through one point
  corridor  two rooms joined by a bottleneck two lanes wide, half of the team from either side
  parking   half of the team backs out of slots between parked cars, the other half backs in
  map       a team somewhere in a real building: --map FILE
The same family, robots and seed give the same file on every machine.
Examples
  seine generate random --robots 26 --seed 3 -o team.yaml
  seine generate map --map office.yaml --robots 4 -o office-team.yaml)";

world::Scenario make(const Arguments& arguments) {
  if (arguments.family == "map") {
    if (arguments.map.empty())
      throw InputError("generate map: needs --map FILE, a ROS map_server map or a MovingAI grid");
    return world::on_map(io::load_map(arguments.map), arguments.robots, arguments.seed);
  }
  const std::optional<world::Family> family = world::family_named(arguments.family);
  if (!family) {
    throw InputError("generate: no family '" + arguments.family +
                     "', expected random, swap, corridor, parking or map");
  }
  if (!arguments.map.empty())
    throw InputError("generate " + arguments.family + ": --map is for the family map only");
  world::FamilyOptions options;
  if (arguments.obstacles >= 0) options.obstacles = arguments.obstacles;
  return world::generate(*family, arguments.robots, arguments.seed, options);
}

int run(const Arguments& arguments) {
  expect_writable(arguments.output);
  const world::Scenario scenario = make(arguments);
  if (!arguments.output.empty()) {
    io::save_scenario(scenario, arguments.output);
  } else if (scenario.map) {
    throw InputError("generate map: needs -o FILE, the map goes beside it");
  } else {
    std::cout << io::scenario_text(scenario);
  }
  return kDone;
}

}  // namespace

void add_generate(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("generate", "makes a random task of a given kind");
  command.footer(kFooter);
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("FAMILY", arguments->family, "random, swap, corridor, parking or map")->required();
  command.add_option("--robots", arguments->robots, "how many cars")->capture_default_str();
  add_seed(command, arguments->seed, "which of the instances");
  command.add_option("--obstacles", arguments->obstacles, "how many, for random only (default: 1 per 20 m2)")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_option("--map", arguments->map, "the map for the family map");
  command.add_option("-o,--output", arguments->output, "file to write (default: stdout)");
  command.callback([&invocation, arguments] { invocation.run = [arguments] { return run(*arguments); }; });
}

}  // namespace seine::app
