#include "seine/io/scenario_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "seine/base/error.hpp"
#include "seine/io/test/equal.hpp"
#include "seine/world/check.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;
using world::Scenario;

const fs::path kData = SEINE_DATA_DIR;

constexpr const char* kSmall = R"(seine: 1
world:
  bounds: [-6, -12, 18, 12]
robots:
  - {start: {x: 0.8, y: 0.8, heading: 0}, goal: {x: 9, y: 2, heading: 7}}
)";

Scenario parse(const std::string& text) {
  return parse_scenario(text, "team.yaml", ".");
}

/// What is said about `text`; empty when nothing.
std::string complaint_about(const std::string& text, const std::string& file = "team.yaml") {
  try {
    parse_scenario(text, file, ".");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ScenarioFile, DefaultsAreTheDocumentedOnes) {
  const Scenario s = parse(kSmall);
  EXPECT_EQ(s.name, "team");
  EXPECT_EQ(s.bounds.low, (geom::Vec2{-6, -12}));
  EXPECT_EQ(s.bounds.high, (geom::Vec2{18, 12}));
  EXPECT_FALSE(s.map);
  EXPECT_EQ(s.margins.robot, 0.05);
  EXPECT_EQ(s.margins.obstacle, 0.05);
  ASSERT_EQ(s.models.size(), 1U);
  EXPECT_EQ(s.models[0].name, "default");
  EXPECT_EQ(s.models[0].footprint, vehicle::rectangle_footprint(0.6, 0.4, 0.1));
  EXPECT_EQ(s.models[0].wheelbase, 0.4);
  EXPECT_EQ(s.models[0].limits.speed, 2.5);
  EXPECT_EQ(s.models[0].limits.reverse_speed, 2.5);
  EXPECT_EQ(s.models[0].limits.acceleration, 3.0);
  EXPECT_EQ(s.models[0].limits.lateral_acceleration, 3.0);
  EXPECT_EQ(s.models[0].limits.steering, 0.7);
  EXPECT_TRUE(std::isinf(s.models[0].limits.steering_rate));
  ASSERT_EQ(s.robots.size(), 1U);
  EXPECT_EQ(s.robots[0].name, "car0");
  EXPECT_EQ(s.robots[0].start_speed, 0.0);
  EXPECT_EQ(s.robots[0].goal->heading, geom::wrap_angle(7.0));
}

constexpr const char* kFull = R"(seine: 1
name: "a full: one"
world:
  bounds: [-6.1, -12, 18, 12.3]
  obstacles:
    - {polygon: [[5.2, 6.2], [5.1, 6.3], [4.8, 6.0]], height: 0.15}
    - {circle: {center: [3, 1], radius: 0.4}, motion: [{t: 0, x: 3, y: 1}, {t: 5.1, x: 6, y: 1}]}
    - {name: gate, polygon: [[0, 0], [1, 0], [1, 1]], motion: [{t: -1, x: 3, y: 1, heading: 2}]}
    - {circle: {center: [3.3, 1], radius: 0.1}, height: .inf}
models:
  default: {}
  truck:
    footprint: {polygon: [[-1, 0.5], [2, 0.3], [2, -0.3], [-1, -0.5]]}
    wheelbase: 1.5
    limits: {speed: 1.1, reverse_speed: 0.7, acceleration: 0.3, lateral_acceleration: .inf, steering: 0.5, steering_rate: 0.9}
  tug:
    footprint: {length: 0.7, width: 0.3, rear_overhang: 0.15}
margins: {robot: 0.1, obstacle: 0.02}
robots:
  - {start: {x: 0.8, y: 0.8, heading: 0, speed: -0.3}, goal: {x: 9, y: 2, heading: 3.14159}}
  - {name: "no", model: truck, start: {x: -4, y: 0.1, heading: 0.3}, goal: {x: 9, y: -2, heading: -9}}
)";

TEST(ScenarioFile, ReadsEveryKey) {
  const Scenario s = parse(kFull);
  EXPECT_EQ(s.name, "a full: one");
  ASSERT_EQ(s.obstacles.size(), 4U);
  EXPECT_EQ(s.obstacles[0].name, "obstacle 1");
  EXPECT_EQ(s.obstacles[0].height, 0.15);
  // The centre of a moving circle is its body frame.
  EXPECT_EQ(std::get<world::Circle>(s.obstacles[1].shape).center, (geom::Vec2{0, 0}));
  ASSERT_EQ(s.obstacles[1].motion.size(), 2U);
  EXPECT_EQ(s.obstacles[1].motion[1].t, 5.1);
  EXPECT_EQ(s.obstacles[1].motion[1].pose, (geom::Pose2{6, 1, 0}));
  EXPECT_EQ(s.obstacles[2].name, "gate");
  EXPECT_EQ(s.obstacles[2].motion[0].pose.heading, 2.0);
  EXPECT_EQ(std::get<world::Circle>(s.obstacles[3].shape).center, (geom::Vec2{3.3, 1}));
  ASSERT_EQ(s.models.size(), 3U);
  // Clockwise in the file, counter-clockwise here.
  EXPECT_EQ(s.models[1].footprint.front(), (geom::Vec2{-1, -0.5}));
  EXPECT_EQ(s.models[1].limits.steering_rate, 0.9);
  EXPECT_EQ(s.models[2].limits.lateral_acceleration, 3.0);
  EXPECT_EQ(s.robots[1].name, "no");
  EXPECT_EQ(s.robots[1].model, 1);
  EXPECT_EQ(s.robots[0].start_speed, -0.3);
}

TEST(ScenarioFile, WritesWhatItReads) {
  for (const char* text : {kSmall, kFull}) {
    const Scenario s = parse(text);
    expect_equal(s, parse(scenario_text(s)));
  }
}

TEST(ScenarioFile, SavesAMapBesideTheScenario) {
  const fs::path folder = fs::temp_directory_path() / "seine-scenario-test";
  fs::create_directories(folder);
  Scenario s = parse(kFull);
  s.map = geom::OccupancyGrid{3, 2, 0.1, {1.5, -0.2, 3.14}, {0, 1, 0, 1, 1, 0}};
  s.outside_free = true;
  save_scenario(s, folder / "a.yaml");
  expect_equal(s, load_scenario(folder / "a.yaml"));
  fs::remove_all(folder);
}

TEST(ScenarioFile, SaysWhatLiesOutsideTheMap) {
  const auto with = [](const std::string& world) {
    return "seine: 1\nworld: {" + world +
           "}\nrobots: [{start: {x: 0, y: 0, heading: 0}, goal: {x: 1, y: 0, heading: 0}}]\n";
  };
  const auto read = [&](const std::string& outside) {
    return parse_scenario(with("map: skirk.yaml" + outside), "a.yaml", kData / "maps/ros").outside_free;
  };
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(read(", outside: unknown"));
  EXPECT_TRUE(read(", outside: free"));
  EXPECT_THROW(read(", outside: open"), InputError);
  EXPECT_EQ(complaint_about(with("bounds: [0, 0, 1, 1], outside: free")),
            "team.yaml:2: 'outside' of 'world' says what lies outside the map, but there is no 'map'");
}

TEST(ScenarioFile, BoundsComeFromTheMap) {
  const Scenario s = parse_scenario(
      "seine: 1\nworld: {map: skirk.yaml}\nrobots: [{start: {x: 0, y: 0, heading: 0}, goal: "
      "{x: 1, y: 0, heading: 0}}]\n",
      "a.yaml", kData / "maps/ros");
  EXPECT_NEAR(s.bounds.low.x, -8.801, 1e-9);
  EXPECT_NEAR(s.bounds.high.y, -11.388 + 602 * 0.05, 1e-9);
}

struct BadCase {
  const char* find;
  const char* put;
  const char* said;  ///< the whole message
};

TEST(ScenarioFile, NamesThePlaceOfEveryMistake) {
  const BadCase cases[] = {
      {"seine: 1", "seine: 2", "team.yaml:1: 'seine' is a format this version cannot read, expected 1"},
      {"seine: 1", "seine: one", "team.yaml:1: 'seine' is 'one', expected a whole number"},
      {"bounds:", "bonds:", "team.yaml:3: unknown key 'bonds' in 'world': did you mean 'bounds'?"},
      {"bounds: [-6, -12, 18, 12]", "obstacles: []",
       "team.yaml:3: 'world' has neither 'bounds' nor 'map', expected bounds: [xmin, ymin, xmax, ymax]"},
      {"-6, -12", "-6, nan",
       "team.yaml:3: entry 2 of 'bounds' of 'world' is 'nan', expected a finite number"},
      {"-6, -12", "-6, .inf",
       "team.yaml:3: entry 2 of 'bounds' of 'world' is '.inf', expected a finite number"},
      {"-6, -12", "-6, 1e400",
       "team.yaml:3: entry 2 of 'bounds' of 'world' is '1e400', expected a finite number"},
      {"-6, -12", "-6", "team.yaml:3: 'bounds' of 'world' has 3 entries, expected 4"},
      {"-6, -12", "19, -12", "team.yaml:3: 'bounds' of 'world' are empty, expected [xmin, ymin, xmax, ymax]"},
      {"x: 0.8, ", "", "team.yaml:5: 'start' of entry 1 of 'robots' has no 'x', which is required"},
      {"x: 0.8", "x: 0.8, x: 1", "team.yaml:5: key 'x' stands twice in 'start' of entry 1 of 'robots'"},
      {"goal:", "gaol:", "team.yaml:5: unknown key 'gaol' in entry 1 of 'robots': did you mean 'goal'?"},
      {"- {start", "- {name: [], start",
       "team.yaml:5: 'name' of entry 1 of 'robots' is a list, expected a text"},
      {"- {start", "- {model: truck, start",
       "team.yaml:5: 'model' of entry 1 of 'robots' is 'truck', expected a model of 'models'"},
      {"world:", "models: {default: {footprint: {polygon: [[0,0],[1,0],[0.2,0.2],[0,1]]}}}\nworld:",
       "team.yaml:2: 'polygon' of 'footprint' of 'default' of 'models' is not convex, expected a convex "
       "polygon"},
      {"world:", "models: {default: {limits: {speed: -1}}}\nworld:",
       "team.yaml:2: 'speed' of 'limits' of 'default' of 'models' is -1, expected from 0.001 to 10000"},
      {"heading: 0}", "heading: 0, speed: 3}",
       "team.yaml:5: 'speed' of 'start' of entry 1 of 'robots' is 3, beyond what the model can drive: -2.5 "
       "to "
       "2.5 m/s, and 1 % more for measured speeds"},
      {"robots:", "  obstacles: [{circle: {radius: 1}}]\nrobots:",
       "team.yaml:4: 'circle' of entry 1 of 'obstacles' of 'world' has no 'center', which is required for a "
       "circle "
       "without motion"},
  };
  for (const BadCase& bad : cases) {
    std::string text = kSmall;
    const std::size_t at = text.find(bad.find);
    ASSERT_NE(at, std::string::npos) << bad.find;
    text.replace(at, std::string(bad.find).size(), bad.put);
    EXPECT_EQ(complaint_about(text), bad.said) << text;
  }
}

TEST(ScenarioFile, RefusesWhatIsNoScenario) {
  EXPECT_EQ(complaint_about(""), "team.yaml:1: is empty, expected YAML");
  EXPECT_EQ(complaint_about("a: [1, 2"), "team.yaml:1: is not valid YAML: end of sequence flow not found");
  EXPECT_EQ(complaint_about("a: 1"),
            "team.yaml:1: is no scenario, expected 'seine: 1' (or a CL-MAPF instance, or a TPCAP .csv)");
  EXPECT_EQ(complaint_about("seine: 1\n---\nseine: 1\n"),
            "team.yaml:1: goes on after its first YAML document, expected one");
  EXPECT_NE(complaint_about(",hih"), "");
  EXPECT_EQ(complaint_about("seine: " + std::string(60, '[')), "team.yaml:1: is nested too deeply");
  EXPECT_NE(complaint_about(std::string(100000, '[')), "");
  EXPECT_NE(complaint_about(std::string(100000, '{')), "");
  std::string many = "seine: 1\nworld: [";
  for (int i = 0; i < 1'300'000; ++i) many += i % 1000 == 999 ? "0,\n" : "0, ";
  EXPECT_EQ(complaint_about(many), "team.yaml:1201: has more than 1200000 values up to here");
  std::string deep = "seine: 1\nworld: ";
  for (int i = 0; i < 100000; ++i) deep += "[";
  EXPECT_NE(complaint_about(deep), "");
}

TEST(ScenarioFile, ExamplesAreAnswerable) {
  for (const auto& entry : fs::directory_iterator(kData / "scenarios")) {
    const Scenario scenario = load_scenario(entry.path());
    EXPECT_EQ(world::check(scenario, world::StaticMap(scenario)), std::vector<std::string>{}) << entry.path();
    expect_equal(scenario, [&] {
      Scenario again = parse(scenario_text(scenario));
      again.map = scenario.map;
      return again;
    }());
  }
}

TEST(ScenarioFile, SameNamesAreRefused) {
  std::string text = kSmall;
  const std::string robot = text.substr(text.find("  - {start"));
  EXPECT_EQ(complaint_about(text + robot), "");
  EXPECT_EQ(complaint_about(text + "  - {name: car0, " + robot.substr(5)),
            "team.yaml:6: entry 2 of 'robots' is called 'car0' like another robot, expected distinct names");
}

TEST(ScenarioFile, AnAliasBombIsCountedNotExpanded) {
  std::string text = "a: &a [[0,0],[1,0],[1,1]";
  for (int i = 0; i < 4000; ++i)
    text += ",[" + std::to_string(1.0 - i * 1e-4) + "," + std::to_string(1 + i) + "]";
  text = "seine: 1\nrobots: []\nworld:\n  bounds: [0, 0, 1, 1]\n  obstacles:\n    - {polygon: " +
         text.substr(3) + "]}\n";
  for (int i = 0; i < 200; ++i) text += "    - {polygon: *a}\n";
  EXPECT_NE(complaint_about(text), "");
}

TEST(Clmapf, ReadsEveryInstance) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kData / "clmapf_clcbs")) {
    if (entry.path().extension() != ".yaml" || entry.path().filename() == "clcbs_config.yaml") continue;
    const Scenario s = load_scenario(entry.path());
    const std::string name = entry.path().stem().string();
    EXPECT_NE(name.find("agents" + std::to_string(s.robots.size()) + "_"), std::string::npos) << name;
    EXPECT_EQ(s.obstacles.size(), name.find("100by100") != std::string::npos ? 50U : 25U) << name;
    for (const world::Robot& robot : s.robots) {
      for (const geom::Pose2& pose : {robot.start, *robot.goal}) {
        for (const geom::Vec2 corner : s.models[0].footprint)
          EXPECT_TRUE(s.bounds.contains(pose * corner)) << name;
      }
    }
    ++count;
  }
  EXPECT_EQ(count, 150);
}

TEST(Clmapf, AQuarterOfTheInstancesStartOrEndInAnObstacle) {
  int unanswerable = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kData / "clmapf_clcbs")) {
    if (entry.path().filename().string().rfind("map_", 0) != 0) continue;
    const Scenario scenario = load_scenario(entry.path());
    unanswerable += world::check(scenario, world::StaticMap(scenario)).empty() ? 0 : 1;
  }
  // Counted by a separate script too, with the yaw turned clockwise; turned the other way it would be 35.
  EXPECT_EQ(unanswerable, 37);
}

TEST(Clmapf, YawTurnsClockwise) {
  const Scenario s = parse(
      "agents: [{start: [28, 18, 0.5], name: a, goal: [9, 17, -1.57]}]\n"
      "map: {dimensions: [50, 60], obstacles: [[3.5, 4]]}\n");
  EXPECT_EQ(s.robots[0].start, (geom::Pose2{28, 18, -0.5}));
  EXPECT_EQ(s.robots[0].goal, (geom::Pose2{9, 17, 1.57}));
  EXPECT_EQ(std::get<world::Circle>(s.obstacles[0].shape).radius, 0.8);
  EXPECT_EQ(s.margins.robot, 0.0);
  EXPECT_EQ(s.bounds.high, (geom::Vec2{50.01, 60.01}));
  expect_equal(s, parse(scenario_text(s)));
}

TEST(Tpcap, ReadsACase) {
  const std::string text = "1,2,7,4,6,0, 2, 3,4, 0,0,1,0,1,1, 5,5,6,5,6,6,6,6\n";
  const Scenario s = parse_scenario(text, "Case0.csv", ".");
  EXPECT_EQ(s.name, "Case0");
  EXPECT_EQ(s.robots[0].start, (geom::Pose2{1, 2, geom::wrap_angle(7)}));
  EXPECT_EQ(s.robots[0].goal, (geom::Pose2{4, 6, 0}));
  EXPECT_EQ(s.bounds.low, (geom::Vec2{-7, -6}));
  EXPECT_EQ(s.bounds.high, (geom::Vec2{12, 14}));
  ASSERT_EQ(s.obstacles.size(), 2U);
  EXPECT_EQ(std::get<0>(s.obstacles[1].shape).size(), 3U);  // the repeated vertex is dropped
  expect_equal(s, parse(scenario_text(s)));
}

TEST(Tpcap, NamesTheValueThatIsWrong) {
  EXPECT_EQ(complaint_about("1,2,x", "a.csv"),
            "a.csv:1: value 3 is no sane number, expected heading of start or goal");
  EXPECT_EQ(complaint_about("1,2", "a.csv"),
            "a.csv:1: value 3 is missing, expected heading of start or goal");
  EXPECT_EQ(complaint_about("1,2,3,1,2,3,1e13", "a.csv"),
            "a.csv:1: value 7 is no sane number, expected the number of obstacles");
  EXPECT_EQ(complaint_about("1,2,3,1,2,3,1,4,0,0", "a.csv"),
            "a.csv:1: value 11 is missing, expected x of a vertex");
  EXPECT_EQ(complaint_about("1,2,3,1,2,3,0,4", "a.csv"), "a.csv:1: goes on after value 7, expected its end");
  EXPECT_EQ(complaint_about("", "a.csv"), "a.csv:1: value 1 is missing, expected x of start or goal");
}

TEST(Tpcap, ReadsEveryCase) {
  if (!fs::exists(kData / "parking_tpcap")) GTEST_SKIP() << "no parking cases in the data folder";
  for (const auto& entry : fs::directory_iterator(kData / "parking_tpcap")) {
    if (entry.path().extension() == ".csv") {
      EXPECT_NO_THROW(load_scenario(entry.path())) << entry.path();
    }
  }
}

}  // namespace
}  // namespace seine::io
