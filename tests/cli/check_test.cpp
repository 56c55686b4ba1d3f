// seine check, and the words in which the program says no.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

using nlohmann::json;

std::string task(const std::string& robots, const std::string& world = "", const std::string& more = "") {
  return "seine: 1\nworld: {bounds: [-5, -5, 5, 5]" + world + "}\n" + more + "robots:\n" + robots;
}
const std::string kAnn =
    "  - {name: ann, start: {x: -3, y: 0, heading: 0}, goal: {x: 3, y: 0, heading: 0}}\n";

TEST(Check, ASoundTask) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome people = scratch.run("check s.yaml");
  EXPECT_EQ(people.status, 0) << people.err;
  EXPECT_EQ(people.out.find("SOUND"), 0u) << people.out;
  EXPECT_EQ(people.err, "");
  const json answer = json::parse(scratch.run("check s.yaml --json").out);
  EXPECT_TRUE(answer.at("sound").get<bool>());
  EXPECT_FALSE(answer.at("impossible").get<bool>());
  ASSERT_EQ(answer.at("places").size(), 4u);
  EXPECT_NEAR(answer.at("places")[0].at("to_obstacles_m").get<double>(), 0.7, 1e-6);  // to the bounds
  EXPECT_TRUE(answer.at("warnings").empty());
}

TEST(Check, AWrongTaskNamesFileAndLine) {
  const Scratch scratch;
  scratch.write(
      "s.yaml",
      task(kAnn + "  - {name: bob, start: {x: -3, y: 0.1, heading: 0}, goal: {x: -2, y: 3, heading: 0}}\n",
           ", obstacles: [{name: well, circle: {center: [3, 0], radius: 0.5}}]"));
  for (const char* command : {"check s.yaml", "plan s.yaml", "simulate s.yaml"}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_NE(outcome.err.find("s.yaml:"), std::string::npos) << outcome.err;
  }
  const json answer = json::parse(scratch.run("check s.yaml --json").out);
  EXPECT_FALSE(answer.at("sound").get<bool>());
  const std::string all = answer.at("errors").dump();
  EXPECT_NE(all.find("s.yaml:4: ann at its start overlaps bob"), std::string::npos) << all;
  EXPECT_NE(all.find("s.yaml:4: ann at its goal overlaps well"), std::string::npos) << all;
}

TEST(Check, ATaskWithoutAnAnswer) {
  const Scratch scratch;
  scratch.write("wall.yaml",
                task(kAnn, ", obstacles: [{name: wall, polygon: [[0, -5], [0.2, -5], [0.2, 5], [0, 5]]}]"));
  const Outcome closed = scratch.run("check wall.yaml");
  EXPECT_EQ(closed.status, 1) << closed.out;
  EXPECT_NE(closed.out.find("proved unreachable"), std::string::npos) << closed.out;
  EXPECT_NE(closed.out.find("by wall"), std::string::npos) << closed.out;
  // Something that comes to rest on a goal: nothing is wrong with the file, and there is no answer.
  scratch.write("van.yaml", task(kAnn,
                                 ", obstacles: [{name: van, circle: {radius: 0.4}, motion: [{t: 0, x: 3, y: "
                                 "4}, {t: 9, x: 3, y: 0}]}]"));
  for (const char* command : {"check van.yaml --json", "plan van.yaml --json"}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 1) << command << outcome.err;
    EXPECT_TRUE(json::parse(outcome.out).at("impossible").get<bool>());
    EXPECT_NE(outcome.out.find("blocked from t"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("van"), std::string::npos) << outcome.out;
  }
}

TEST(Check, SlipsAreNoted) {
  const Scratch scratch;
  std::string text = task(kAnn, "", "margins: {leaving: 0.2}\n");
  text.replace(text.find("heading: 0"), 10, "heading: 90");
  scratch.write("s.yaml", text);
  const json answer = json::parse(scratch.run("check s.yaml --json").out);
  const std::string warnings = answer.at("warnings").dump();
  EXPECT_NE(warnings.find("'90 deg'"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("'leaving' of 0.2 m has no effect"), std::string::npos) << warnings;
  const Outcome plan = scratch.run("plan s.yaml");
  EXPECT_NE(plan.err.find("seine: note: s.yaml:"), std::string::npos) << plan.err;
}

TEST(Messages, AMissingFileIsNamedByTheOneThatRefersToIt) {
  const Scratch scratch;
  scratch.write("s.yaml", "seine: 1\nworld: {map: nowhere.yaml}\nrobots:\n" + kAnn);
  EXPECT_NE(scratch.run("plan s.yaml").err.find("s.yaml:2: 'map' of 'world' is 'nowhere.yaml'"),
            std::string::npos);
  scratch.write("i.yaml", "seine: 1\nimport: nowhere.csv\n");
  EXPECT_NE(scratch.run("plan i.yaml").err.find("i.yaml:2: 'import' is 'nowhere.csv'"), std::string::npos);
  scratch.write("m.yaml", "image: gone.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
  scratch.write("s.yaml", "seine: 1\nworld: {map: m.yaml}\nrobots:\n" + kAnn);
  EXPECT_NE(scratch.run("plan s.yaml").err.find("m.yaml:1: 'image' is 'gone.png'"), std::string::npos);
}

TEST(Messages, AProofOutOfTimeIsUndecided) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run("generate swap --robots 8 -o s.yaml").status, 0);
  ASSERT_EQ(scratch.run("plan s.yaml -o p.json").status, 0);
  const Outcome outcome = scratch.run("certify s.yaml p.json --deadline 1e-9");
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_EQ(outcome.out.find("UNDECIDED"), 0u) << outcome.out;
  const json answer = json::parse(scratch.run("certify s.yaml p.json --deadline 1e-9 --json").out);
  EXPECT_EQ(answer.at("verdict"), "undecided");
  EXPECT_FALSE(answer.at("certified").get<bool>());
}

TEST(Messages, LinesMayEndAsTheyLike) {
  const Scratch scratch;
  for (const std::string& end : {std::string("\r"), std::string("\r\n"), std::string("\n")}) {
    std::string text;
    for (const char c : two_cars()) text += c == '\n' ? end : std::string(1, c);
    scratch.write("s.yaml", text);
    EXPECT_EQ(scratch.run("check s.yaml").status, 0) << scratch.run("check s.yaml").err;
  }
}

}  // namespace
}  // namespace seine::tests
