// Malformed, hostile and impossible input: one clear line, the right status, within a second, never a crash.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

struct Bad {
  const char* name;
  std::string text;      ///< of the scenario
  std::string expected;  ///< what the line must contain
  std::string file = "bad.yaml";
  friend std::ostream& operator<<(std::ostream& out, const Bad& bad) { return out << bad.name; }
};

std::string with_robots(const std::string& robots, const std::string& more = "") {
  return "seine: 1\nworld: {bounds: [-5, -5, 5, 5]" + more + "}\nrobots:\n" + robots;
}
const std::string kCar = "  - {name: ann, start: {x: 0, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n";

class BadInput : public testing::TestWithParam<Bad> {};

TEST_P(BadInput, IsRefusedInOneLine) {
  const Scratch scratch;
  scratch.write(GetParam().file, GetParam().text);
  const Outcome outcome = scratch.run("plan " + GetParam().file);
  EXPECT_EQ(outcome.status, 2) << outcome.out << outcome.err;
  EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
  EXPECT_LT(outcome.err.size(), 600U) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().expected), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("internal"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_LT(outcome.seconds, 1.0 * patience());
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadInput,
    testing::Values(
        Bad{"empty", "", "bad.yaml"}, Bad{"blank", "\n\n", "bad.yaml"},
        Bad{"binary",
            std::string("\x7f"
                        "ELF\0\1\2\0",
                        8),
            "bad.yaml"},
        Bad{"unclosed", "seine: 1\nworld: {bounds: [0, 0", "bad.yaml:"},
        Bad{"a list", "[1, 2, 3]\n", "bad.yaml"}, Bad{"deep nesting", repeated("[", 100000), "bad.yaml"},
        Bad{"deep maps", repeated("{a: ", 50000), "bad.yaml"},
        Bad{"aliases", "a: &a [x,x]\nb: &b [*a,*a,*a,*a]\nc: &c [*b,*b,*b,*b]\nseine: [*c,*c]\n", "bad.yaml"},
        Bad{"other version", "seine: 7\n", "bad.yaml:1"},
        Bad{"no version", "world: {bounds: [0, 0, 1, 1]}\n", "seine"},
        Bad{"no bounds", "seine: 1\nworld: {}\nrobots:\n" + kCar, "bounds"},
        Bad{"unknown key", two_cars("margin: {robot: 1}\n"), "did you mean 'margins'"},
        Bad{"wrong type", with_robots("  - {start: here, goal: {x: 3, y: 0, heading: 0}}\n"), "bad.yaml:4"},
        Bad{"not a number",
            with_robots("  - {start: {x: .nan, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n"),
            "bad.yaml:4"},
        Bad{"infinite",
            with_robots("  - {start: {x: .inf, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n"),
            "bad.yaml:4"},
        Bad{"huge",
            with_robots("  - {start: {x: 1e300, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n"),
            "bad.yaml:4"},
        Bad{"no robots", "seine: 1\nworld: {bounds: [0, 0, 9, 9]}\nrobots: []\n", "robots"},
        Bad{"no robots key", "seine: 1\nworld: {bounds: [0, 0, 9, 9]}\n", "robots"},
        Bad{"no goal", with_robots("  - {name: ann, start: {x: 0, y: 0, heading: 0}}\n"), "goal"},
        Bad{"zero limits", two_cars("models: {default: {limits: {speed: 0}}}\n"), "speed"},
        Bad{"zero wheelbase", two_cars("models: {default: {wheelbase: 0}}\n"), "wheelbase"},
        Bad{"unknown model",
            with_robots(
                "  - {model: truck, start: {x: 0, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n"),
            "truck"},
        Bad{"inside out", "seine: 1\nworld: {bounds: [5, 5, -5, -5]}\nrobots:\n" + kCar, "bounds"},
        Bad{"crossing polygon",
            with_robots(kCar, ", obstacles: [{polygon: [[2, 2], [4, 4], [4, 2], [2, 4]]}]"), "cross"},
        Bad{"missing map", "seine: 1\nworld: {map: nowhere.yaml}\nrobots:\n" + kCar, "nowhere.yaml"},
        Bad{"csv of words", "1,2,three\n", "bad.csv", "bad.csv"},
        Bad{"short csv", "1,2,3\n", "bad.csv", "bad.csv"},
        Bad{"csv with a huge count", "0,0,0,5,5,0,1e12,4\n", "bad.csv", "bad.csv"},
        Bad{"csv with nan", "0,0,nan,5,5,0,0\n", "bad.csv", "bad.csv"}));

INSTANTIATE_TEST_SUITE_P(
    Places, BadInput,
    testing::Values(
        Bad{"start in an obstacle",
            with_robots(kCar, ", obstacles: [{name: well, circle: {center: [0.2, 0], radius: 0.5}}]"), "ann"},
        Bad{"which obstacle", with_robots(kCar, ", obstacles: [{circle: {center: [0.2, 0], radius: 0.5}}]"),
            "obstacle 1"},
        Bad{"goal in an obstacle",
            with_robots(kCar, ", obstacles: [{circle: {center: [3, 0], radius: 0.5}}]"), "goal"},
        Bad{"start outside",
            with_robots("  - {name: ann, start: {x: 9, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n"),
            "ann"},
        Bad{"starts overlap",
            with_robots(
                kCar +
                "  - {name: bob, start: {x: 0.1, y: 0, heading: 0}, goal: {x: -3, y: 0, heading: 0}}\n"),
            "bob"},
        Bad{"goals overlap",
            with_robots(
                kCar +
                "  - {name: bob, start: {x: -2, y: 0, heading: 0}, goal: {x: 3, y: 0.1, heading: 0}}\n"),
            "bob"},
        Bad{"one name twice",
            with_robots(
                kCar +
                "  - {name: ann, start: {x: -2, y: 0, heading: 0}, goal: {x: -3, y: 0, heading: 0}}\n"),
            "ann"}));

TEST(BadInput, MapsAreDoubted) {
  const Scratch scratch;
  scratch.write("s.yaml", "seine: 1\nworld: {map: m.yaml}\nrobots:\n" + kCar);
  scratch.write("m.yaml",
                "image: m.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: "
                "0.65\nfree_thresh: 0.2\n");
  for (const std::string& picture :
       {std::string(), std::string("P5\n999999999 999999999\n255\n"), std::string("P5\n-4 4\n255\n"),
        std::string("P5\n40 40\n255\nshort"), std::string("P5\n0 0\n255\n"), std::string("P9\n4 4\n255\n"),
        std::string("\x89PNG\r\n\x1a\nrubbish")}) {
    scratch.write("m.pgm", picture);
    const Outcome outcome = scratch.run("plan s.yaml");
    EXPECT_EQ(outcome.status, 2) << picture;
    EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
    EXPECT_LT(outcome.seconds, 1.0 * patience());
  }
}

TEST(BadInput, PlansAreDoubted) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string("{}"), std::string("nonsense"),
        repeated("[", 200000), repeated("{\"a\":", 200000), std::string("{\"seine_plan\": 1, \"robots\": 7}"),
        std::string("\xff\xfe\x00\x01", 4)}) {
    scratch.write("p.json", text);
    for (const char* command : {"certify s.yaml p.json", "plot s.yaml p.json -o p.svg",
                                "export s.yaml p.json --rate 10 -o p.csv"}) {
      const Outcome outcome = scratch.run(command);
      EXPECT_EQ(outcome.status, 2) << command << ": " << outcome.err;
      EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
      EXPECT_EQ(outcome.err.find("internal"), std::string::npos) << outcome.err;
      EXPECT_LT(outcome.seconds, 1.0 * patience());
    }
  }
}

TEST(BadInput, JsonSaysItToo) {
  const Scratch scratch;
  scratch.write("s.yaml", "seine: 1\n");
  const Outcome outcome = scratch.run("plan s.yaml --json");
  EXPECT_EQ(outcome.status, 2);
  const nlohmann::json answer = nlohmann::json::parse(outcome.out);
  EXPECT_NE(outcome.err.find(answer.at("error").get<std::string>()), std::string::npos);
}

TEST(BadInput, AGoalBehindWallsIsAnHonestNo) {
  const Scratch scratch;
  scratch.write("s.yaml",
                with_robots(kCar, ", obstacles: [{polygon: [[2, -5], [2.2, -5], [2.2, 5], [2, 5]]}]"));
  const Outcome outcome = scratch.run("plan s.yaml -o p.json --json");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(nlohmann::json::parse(outcome.out).at("reason").get<std::string>().find("ann"), std::string::npos)
      << outcome.out;
  EXPECT_FALSE(scratch.has("p.json"));
  EXPECT_LT(outcome.seconds, 1.0 * patience());
}

}  // namespace
}  // namespace seine::tests
