// What other programs write into files: all of it means what it means there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/test/equal.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;
using geom::Vec2;
using world::Scenario;

Scenario parse(const std::string& text, const std::string& file = "team.yaml") {
  return parse_scenario(text, file, ".");
}

std::string complaint_about(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string with_obstacle(const std::string& obstacle) {
  return "seine: 1\nworld:\n  bounds: [-9, -9, 9, 9]\n  obstacles:\n    - " + obstacle +
         "\nrobots:\n  - {start: {x: -5, y: 0, heading: 0}, goal: {x: 5, y: 0, heading: 0}}\n";
}

std::string ring_text(const std::vector<Vec2>& ring) {
  std::string text = "[";
  char point[80];
  for (const Vec2 p : ring) {
    std::snprintf(point, sizeof point, "%s[%.17g, %.17g]", text.size() > 1 ? ", " : "", p.x, p.y);
    text += point;
  }
  return text + "]";
}

// A star-shaped ring with every way of writing it that files bring.
TEST(UsersFiles, RingsMayBeClosedRepeatedAndTurnedEitherWay) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    std::vector<Vec2> plain;
    const int corners = 3 + rng.below(8);
    for (int i = 0; i < corners; ++i) plain.push_back(rng.uniform(0.5, 2.0) * geom::unit(6.28 * i / corners));
    std::vector<Vec2> written = plain;
    if (rng.below(2) == 0) std::reverse(written.begin(), written.end());
    const auto nudge = [&] { return Vec2{rng.uniform(-1e-12, 1e-12), rng.uniform(-1e-12, 1e-12)}; };
    for (int i = rng.below(4); i > 0; --i) {  // a vertex twice
      const auto at = static_cast<std::size_t>(rng.below(static_cast<int>(written.size())));
      written.insert(written.begin() + static_cast<std::ptrdiff_t>(at), written[at] + nudge());
    }
    if (rng.below(3) == 0) written.insert(written.end(), written.begin(), written.end());  // twice round
    for (int i = rng.below(3); i > 0; --i) written.push_back(written.front() + nudge());   // closed, or twice
    const Scenario s = parse(with_obstacle("{polygon: " + ring_text(written) + "}"));
    const auto& read = std::get<std::vector<Vec2>>(s.obstacles[0].shape);
    EXPECT_EQ(read.size(), plain.size());
    EXPECT_NEAR(std::abs(geom::signed_area(read)), geom::signed_area(plain), 1e-9);
  }
}

TEST(UsersFiles, ARingThatIsNothingIsStillRefused) {
  EXPECT_NE(complaint_about(with_obstacle("{polygon: [[0, 0], [1, 0], [0, 0]]}")).find("3 vertices"),
            std::string::npos);
  EXPECT_NE(complaint_about(with_obstacle("{polygon: [[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]}")), "");
}

std::string with_footprint(const std::string& polygon) {
  return "seine: 1\nworld: {bounds: [-9, -9, 9, 9]}\nmodels: {default: {footprint: {polygon: " + polygon +
         "}}}\nrobots:\n  - {start: {x: -5, y: 0, heading: 0}, goal: {x: 5, y: 0, heading: 0}}\n";
}

TEST(UsersFiles, FootprintsMayBeClosedAndHaveVerticesOnTheirSides) {
  for (const char* text :
       {"[[-0.1, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.1, 0.2], [-0.1, -0.2]]",
        "[[-0.1, 0.2], [0.5, 0.2], [0.5, -0.2], [-0.1, -0.2], [-0.1, 0.2], [-0.1, 0.2]]"}) {
    const auto footprint = parse(with_footprint(text)).models[0].footprint;
    EXPECT_EQ(footprint.size(), 4U);
    EXPECT_NEAR(geom::signed_area(footprint), 0.24, 1e-12);
  }
  // A side that rounding bends inwards by a nanometre.
  const auto footprint =
      parse(with_footprint("[[-0.1, -0.2], [0.2, -0.199999999], [0.5, -0.2], [0.5, 0.2], [-0.1, 0.2]]"))
          .models[0]
          .footprint;
  EXPECT_NEAR(geom::signed_area(footprint), 0.24, 1e-9);
  EXPECT_NE(complaint_about(with_footprint("[[-0.1, -0.2], [0.2, -0.1], [0.5, -0.2], [0.5, 0.2]]")), "");
}

TEST(UsersFiles, MergeKeysBringWhatTheMapDoesNotHave) {
  const Scenario s = parse(R"(seine: 1
x-base: &base {wheelbase: 0.3, limits: &slow {speed: 1, acceleration: 0.5}}
world: {bounds: [-9, -9, 9, 9]}
models:
  a: &a
    <<: *base
    footprint: {length: 0.5}
  b: {<<: *a, wheelbase: 0.35}
  c:
    <<: [{wheelbase: 0.31}, *a]
    limits: {<<: *slow, speed: 2}
robots:
  - &r {model: a, start: {x: -5, y: 0, heading: 0}, goal: &g {x: 5, y: 0, heading: 0}}
  - {<<: *r, model: c, name: second, goal: {<<: *g, y: 2}}
)");
  ASSERT_EQ(s.models.size(), 3U);
  EXPECT_EQ(s.models[0].wheelbase, 0.3);
  EXPECT_EQ(s.models[0].limits.speed, 1.0);
  EXPECT_EQ(s.models[1].wheelbase, 0.35);
  EXPECT_EQ(s.models[1].footprint, s.models[0].footprint);
  EXPECT_EQ(s.models[2].wheelbase, 0.31);
  EXPECT_EQ(s.models[2].limits.speed, 2.0);
  EXPECT_EQ(s.models[2].limits.acceleration, 0.5);
  EXPECT_EQ(s.robots[1].goal->y, 2.0);
  EXPECT_EQ(s.robots[1].goal->x, 5.0);
  EXPECT_EQ(s.robots[1].model, 2);
}

TEST(UsersFiles, MergesThatMakeNoSenseEndWithAMessage) {
  const std::string rest =
      "world: {bounds: [-9, -9, 9, 9]}\nrobots: [{start: {x: 0, y: 0, heading: 0}, goal: {x: 5, y: 0, "
      "heading: 0}}]\n";
  EXPECT_NE(complaint_about("seine: 1\nmodels: {default: {<<: 3}}\n" + rest).find("'<<'"), std::string::npos);
  EXPECT_NE(complaint_about("seine: 1\nmodels: {default: &m {<<: *m, wheelbase: 1}}\n" + rest), "");
  EXPECT_NE(complaint_about("seine: 1\nmodels: {default: {<<: {wheelbas: 1}}}\n" + rest).find("wheelbase"),
            std::string::npos);
  std::string bomb = "seine: 1\nx-0: &m0 {wheelbase: 1}\n";
  for (int i = 1; i < 30; ++i) {
    const std::string one = std::to_string(i), before = std::to_string(i - 1);
    bomb += "x-" + one + ": &m" + one + " {<<: [*m" + before + ", *m" + before + "]}\n";
  }
  EXPECT_NE(complaint_about(bomb + "models: {default: {<<: *m29}}\n" + rest).find("too many"),
            std::string::npos);
}

TEST(UsersFiles, MarksAndLineEndsOfOtherSystemsMeanNothing) {
  const std::string plain = with_obstacle("{polygon: [[0, 1], [1, 1], [1, 2]]}");
  std::string crlf;
  for (const char c : plain) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  const Scenario expected = parse(plain);
  for (const std::string& text : {"\xef\xbb\xbf" + plain, crlf, "\xef\xbb\xbf" + crlf})
    expect_equal(expected, parse(text));
  const std::string csv = "0,0,0,5,0,0,1,3,1,4,2,4,2,5";
  const Scenario one = parse(csv, "case.csv");
  for (const std::string& text : {"\xef\xbb\xbf" + csv, csv + "\r\n", "\xef\xbb\xbf" + csv + ",\r\n"})
    expect_equal(one, parse(text, "case.csv"));
}

constexpr const char* kAgents = R"(agents:
- {start: [5, 5, 0], goal: [40, 5, 0], name: agent0}
map:
  dimensions: [50, 50]
  obstacles:
  - [20, 10, 0.5]
  - [20, 30]
)";

TEST(UsersFiles, DiscsMayHaveTheirRadius) {
  const Scenario s = parse(kAgents);
  EXPECT_EQ(std::get<world::Circle>(s.obstacles[0].shape).radius, 0.5);
  EXPECT_EQ(std::get<world::Circle>(s.obstacles[1].shape).radius, 0.8);
}

TEST(UsersFiles, AScenarioAroundAnImportSetsMarginsAndCar) {
  const fs::path folder = fs::temp_directory_path() / "seine-import-test";
  fs::create_directories(folder);
  std::ofstream(folder / "agents.yaml") << kAgents;
  std::ofstream(folder / "case.csv") << "0,0,0,5,0,0,0";
  std::ofstream(folder / "team.yaml")
      << "seine: 1\nimport: agents.yaml\nmargins: {robot: 0.2, obstacle: 0.1}\n"
      << "models: {van: {wheelbase: 2.5}}\n";
  std::ofstream(folder / "park.yaml") << "seine: 1\nname: p\nimport: case.csv\nmargins: {obstacle: 0.3}\n";
  std::ofstream(folder / "twice.yaml") << "seine: 1\nimport: team.yaml\n";
  std::ofstream(folder / "car.yaml") << "wheelbase: 0.7\n";
  const Scenario team = load_scenario(folder / "team.yaml"), park = load_scenario(folder / "park.yaml");
  EXPECT_EQ(team.margins.robot, 0.2);
  EXPECT_EQ(team.margins.obstacle, 0.1);
  EXPECT_EQ(team.models.at(0).wheelbase, 2.5);
  EXPECT_EQ(team.robots.at(0).goal->x, 40.0);
  EXPECT_EQ(park.name, "p");
  EXPECT_EQ(park.margins.obstacle, 0.3);
  EXPECT_EQ(park.margins.robot, 0.0);
  EXPECT_EQ(park.models.at(0).wheelbase, 2.8);
  EXPECT_THROW(load_scenario(folder / "twice.yaml"), InputError);
  const Scenario changed =
      load_scenario(folder / "agents.yaml",
                    {.robot_margin = 0.4, .obstacle_margin = {}, .model = load_model(folder / "car.yaml")});
  EXPECT_EQ(changed.margins.robot, 0.4);
  EXPECT_EQ(changed.margins.obstacle, 0.0);
  EXPECT_EQ(changed.models.at(0).wheelbase, 0.7);
  fs::remove_all(folder);
}

std::string with_speed(double speed, double reverse) {
  return "seine: 1\nworld: {bounds: [-9, -9, 9, 9]}\nmodels: {default: {limits: {reverse_speed: " +
         std::to_string(reverse) +
         "}}}\nrobots:\n  - {start: {x: -5, y: 0, heading: 0, speed: " + std::to_string(speed) +
         "}, goal: {x: 5, y: 0, heading: 0}}\n";
}

TEST(UsersFiles, AMeasuredSpeedMayBeALittleOverTheLimit) {
  EXPECT_EQ(parse(with_speed(2.5001, 1)).robots[0].start_speed, 2.5);
  EXPECT_EQ(parse(with_speed(2.524, 1)).robots[0].start_speed, 2.5);
  EXPECT_EQ(parse(with_speed(-1.009, 1)).robots[0].start_speed, -1.0);
  EXPECT_EQ(parse(with_speed(-0.0009, 0)).robots[0].start_speed, 0.0);
  EXPECT_EQ(parse(with_speed(2.4999, 1)).robots[0].start_speed, 2.4999);
  EXPECT_NE(complaint_about(with_speed(2.53, 1)).find("1 %"), std::string::npos);
  EXPECT_NE(complaint_about(with_speed(-0.01, 0)), "");
}

TEST(UsersFiles, CoordinatesOfProjectionsAreRead) {
  const Scenario s = parse(
      "seine: 1\nworld: {bounds: [448100, 9999000, 448150, 9999050]}\nrobots:\n"
      "  - {start: {x: 448123.5, y: 9999020.2, heading: 0}, goal: {x: 448131.5, y: 9999024.2, heading: "
      "0}}\n");
  EXPECT_EQ(s.robots[0].start.y, 9999020.2);
  EXPECT_NE(complaint_about("seine: 1\nworld: {bounds: [-9e6, 0, 9e6, 5]}\nrobots: []\n").find("2000 km"),
            std::string::npos);
}

}  // namespace
}  // namespace seine::io
