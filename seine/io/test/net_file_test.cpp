// The keys of a team with a net: read, written, refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "seine/base/error.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/test/equal.hpp"
#include "seine/net/shape.hpp"

namespace seine::io {
namespace {

using world::Scenario;

constexpr const char* kTriangle = R"(seine: 1
world: {bounds: [-6, -6, 6, 6]}
robots:
  - {start: {x: 1, y: 0, heading: 0}}
  - {start: {x: -0.5, y: 0.8, heading: 0}}
  - {start: {x: -0.5, y: -0.8, heading: 0}}
net:
  regular: {side: 2.2}
targets:
  - {position: [0, 0, 3], velocity: [1, 0, 0]}
delivery: {center: [3, 0]}
)";

constexpr const char* kEverything = R"(seine: 1
world: {bounds: [-6, -6, 6, 6]}
robots:
  - {start: {x: 1, y: 0, heading: 0}, goal: {x: 4, y: 0, heading: 0}}
  - {start: {x: 0, y: 1, heading: 0}}
  - {start: {x: -1, y: 0, heading: 0}}
  - {start: {x: 0, y: -1, heading: 0}}
net:
  rest: [[1.1, 0.1], [0, 1.2], [-1.3, 0], [0, -1]]
  attachment: [{x: -0.05, z: 0.8}, {x: 0.2, y: 0.1, z: 0.8}, {z: 0.8}, {x: 0.3, y: -0.1, z: 0.8}]
  stretch: 0.93
  clearance: 0.07
  rebound: 0.2
targets:
  - {time: 0.8, position: [-3.9, 3.7, 1.9], velocity: [2.6, -3.3, 4.3], radius: 0.06, mass: 0.1, drag: 0.05,
     covariance: [[1e-4, 2e-5, 0, 0, 0, 0], [2e-5, 1e-4, 0, 0, 0, 0], [0, 0, 3e-4, 0, 0, 0], [0, 0, 0, 0.01, 0, 0], [0, 0, 0, 0, 0.01, 0.01],
                  [0, 0, 0, 0, 0.01, 0.01]]}
  - {time: 3, position: [0, 0, 5], velocity: [0, 0, 0]}
delivery: {center: [3, 0.5], radius: 0.4, heading: 4}
)";

Scenario parse(const std::string& text) {
  return parse_scenario(text, "net.yaml", ".");
}

std::string complaint_about(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NetFile, DefaultsAreTheDocumentedOnes) {
  const Scenario s = parse(kTriangle);
  ASSERT_TRUE(s.net.has_value());
  ASSERT_EQ(s.net->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(net::rest_distance(*s.net, i, (i + 1) % 3), 2.2, 1e-12);
    EXPECT_EQ(s.net->attachments[i].at, (geom::Vec2{0.2, 0.0}));
    EXPECT_FALSE(s.robots[i].goal.has_value());
  }
  EXPECT_EQ(s.net->rest[0].y, 0.0);
  EXPECT_GT(geom::signed_area(s.net->rest), 0.0);
  EXPECT_EQ(s.net->rim(), 1.0);
  EXPECT_EQ(s.net->stretch, 0.95);
  EXPECT_EQ(s.net->clearance, 0.05);
  EXPECT_EQ(s.net->rebound, 0.25);
  ASSERT_EQ(s.targets.size(), 1U);
  EXPECT_EQ(s.targets[0].time, 0.0);
  EXPECT_EQ(s.targets[0].radius, 0.08);
  EXPECT_EQ(s.targets[0].mass, 0.25);
  EXPECT_EQ(s.targets[0].drag, 0.0);
  EXPECT_FALSE(s.payload.has_value());
  EXPECT_EQ(s.delivery->radius, 0.5);
  EXPECT_FALSE(s.delivery->heading.has_value());
}

TEST(NetFile, ReadsEveryKey) {
  const Scenario s = parse(kEverything);
  EXPECT_EQ(s.net->rest[1], (geom::Vec2{0.0, 1.2}));
  EXPECT_EQ(s.net->attachments[0].at, (geom::Vec2{-0.05, 0.0}));
  EXPECT_EQ(s.net->attachments[2].at, (geom::Vec2{0.2, 0.0}));
  EXPECT_EQ(s.net->rim(), 0.8);
  EXPECT_EQ(s.net->stretch, 0.93);
  EXPECT_EQ(s.net->clearance, 0.07);
  EXPECT_EQ(s.net->rebound, 0.2);
  ASSERT_EQ(s.targets.size(), 2U);
  EXPECT_EQ(s.targets[0].velocity, (geom::Vec3{2.6, -3.3, 4.3}));
  EXPECT_EQ(s.targets[0].drag, 0.05);
  EXPECT_EQ(s.targets[0].covariance[0][1], 2e-5);
  EXPECT_EQ(s.targets[0].covariance[5][5], 0.01);
  EXPECT_EQ(s.delivery->center, (geom::Vec2{3.0, 0.5}));
  EXPECT_EQ(*s.delivery->heading, geom::wrap_angle(4.0));
  EXPECT_TRUE(s.robots[0].goal.has_value());
  EXPECT_FALSE(s.robots[1].goal.has_value());
}

TEST(NetFile, WritesWhatItReads) {
  std::string carry = kTriangle;
  carry.replace(carry.find("targets:"), carry.find("delivery:") - carry.find("targets:"),
                "payload: {radius: 0.1, mass: 0.5}\n");
  for (const std::string& text : {std::string(kTriangle), std::string(kEverything), carry}) {
    const Scenario s = parse(text);
    expect_equal(s, parse(scenario_text(s)));
  }
  EXPECT_EQ(parse(carry).payload->mass, 0.5);
}

struct BadCase {
  const char* find;
  const char* put;
  const char* said;  // the whole message
};

TEST(NetFile, NamesThePlaceOfEveryMistake) {
  const BadCase cases[] = {
      {"regular: {side: 2.2}", "rest: [[0, 0], [1, 0]]",
       "net.yaml:8: 'rest' of 'net' has 2 entries, expected 3 to 16"},
      {"regular: {side: 2.2}", "rest: [[0, 0], [1, 0], [1, 1], [0, 1]]",
       "net.yaml:8: 'rest' of 'net' has 4 entries, expected one for each of the 3 robots"},
      {"regular: {side: 2.2}", "rest: [[0, 0], [0, 1], [1, 0]]",
       "net.yaml:8: 'rest' of 'net' is clockwise, expected counter-clockwise corners in the order of the "
       "robots"},
      {"regular: {side: 2.2}", "regular: {side: 0}",
       "net.yaml:8: 'side' of 'regular' of 'net' is 0, expected from 1e-04 to 10000"},
      {"regular: {side: 2.2}", "{}", "net.yaml:8: 'net' expected one of 'regular' and 'rest'"},
      {"side: 2.2}", "side: 2.2}\n  stretch: 1",
       "net.yaml:9: 'stretch' of 'net' is 1, expected more than 0.5 and less than 1"},
      {"side: 2.2}", "side: 2.2}\n  rebound: 0",
       "net.yaml:9: 'rebound' of 'net' is 0, expected more than 0 and less than 1"},
      {"side: 2.2}", "side: 2.2}\n  clearance: -0.1",
       "net.yaml:9: 'clearance' of 'net' is -0.1, expected from 0 to 100"},
      {"side: 2.2}", "side: 2.2}\n  atachment: {}",
       "net.yaml:9: unknown key 'atachment' in 'net': did you mean 'attachment'?"},
      {"side: 2.2}", "side: 2.2}\n  attachment: [{}, {}]",
       "net.yaml:9: 'attachment' of 'net' has 2 entries, expected one for each of the 3 robots"},
      {"side: 2.2}", "side: 2.2}\n  attachment: [{}, {}, {}, {}]",
       "net.yaml:9: 'attachment' of 'net' has 4 entries, expected one for each of the 3 robots"},
      {"side: 2.2}", "side: 2.2}\n  attachment: [{}, {}, {z: 0.9}]",
       "net.yaml:9: entry 3 of 'attachment' of 'net' has z = 0.9, the first has 1; attachments at different "
       "heights are not supported"},
      {"velocity: [1, 0, 0]", "velocity: [1, 0, 0], mass: -1",
       "net.yaml:10: 'mass' of entry 1 of 'targets' is -1, expected from 1e-04 to 10000"},
      {"velocity: [1, 0, 0]", "velocity: [1, 0, 0], radius: -0.08",
       "net.yaml:10: 'radius' of entry 1 of 'targets' is -0.08, expected from 1e-04 to 10000"},
      {"velocity: [1, 0, 0]", "velocity: [1, 0, 0], drag: -0.1",
       "net.yaml:10: 'drag' of entry 1 of 'targets' is -0.1, expected from 0 to 100"},
      {", velocity: [1, 0, 0]", "", "net.yaml:10: entry 1 of 'targets' has no 'velocity', which is required"},
      {"position: [0, 0, 3], ", "", "net.yaml:10: entry 1 of 'targets' has no 'position', which is required"},
      {"position: [0, 0, 3]", "position: [0, 0]",
       "net.yaml:10: 'position' of entry 1 of 'targets' has 2 entries, expected 3"},
      {"delivery:", "payload: {}\ndelivery:",
       "net.yaml:11: 'payload' is given together with 'targets', expected one of them"},
      {"center: [3, 0]", "radius: 1", "net.yaml:11: 'delivery' has no 'center', which is required"},
      {"center: [3, 0]", "center: [3, 0], radius: -1",
       "net.yaml:11: 'radius' of 'delivery' is -1, expected from 1e-04 to 10000"},
      {"net:\n  regular: {side: 2.2}\n", "",
       "net.yaml:4: entry 1 of 'robots' has no 'goal', which is required for a team without a net"},
  };
  for (const BadCase& bad : cases) {
    std::string text = kTriangle;
    const std::size_t at = text.find(bad.find);
    ASSERT_NE(at, std::string::npos) << bad.find;
    text.replace(at, std::string(bad.find).size(), bad.put);
    EXPECT_EQ(complaint_about(text).substr(0, std::string(bad.said).size()), bad.said) << text;
  }
}

TEST(NetFile, ARestPolygonMustBeSimpleAndConvex) {
  const auto with = [](const char* rest) {
    std::string text = kEverything;
    const std::size_t at = text.find("[[1.1");
    return text.replace(at, text.find('\n', at) - at, rest);
  };
  EXPECT_EQ(complaint_about(with("[[0, 0], [1, 1], [1, 0], [0, 1]]")).substr(0, 43),
            "net.yaml:9: 'rest' of 'net' is not simple: ");
  EXPECT_EQ(complaint_about(with("[[0, 0], [2, 0], [0.5, 0.5], [0, 2]]")),
            "net.yaml:9: 'rest' of 'net' is not convex, expected a convex polygon");
  EXPECT_EQ(complaint_about(with("[[0, 0], [2, 0], [2, 2], [0, 2]]")), "");
}

TEST(NetFile, OnlyATeamWithANetCatchesAndDelivers) {
  std::string text = kTriangle;
  for (const char* pose : {"heading: 0}}", "heading: 0}}", "heading: 0}}"}) {
    text.replace(text.find(pose), std::string(pose).size(), "heading: 0 }, goal: {x: 0, y: 0, heading: 0 }}");
  }
  text.erase(text.find("net:"), text.find("targets:") - text.find("net:"));
  EXPECT_EQ(complaint_about(text),
            "net.yaml:8: 'targets' is given without a 'net', expected the net that the team holds");
  text.erase(text.find("targets:"), text.find("delivery:") - text.find("targets:"));
  EXPECT_EQ(complaint_about(text),
            "net.yaml:7: 'delivery' is given without a 'net', expected the net that the team holds");
  text.erase(text.find("delivery:"));
  EXPECT_EQ(complaint_about(text + "payload: {}\n"),
            "net.yaml:7: 'payload' is given without a 'net', expected the net that the team holds");
  EXPECT_EQ(complaint_about(text), "");
}

TEST(NetFile, ACovarianceIsSymmetricAndNotNegative) {
  const auto with = [](const char* first_row, const char* second_row) {
    std::string text = kTriangle;
    const std::string zero = "[0, 0, 0, 0, 0, 0]";
    std::string matrix = std::string("velocity: [1, 0, 0], covariance: [") + first_row + ", " + second_row;
    for (int i = 0; i < 4; ++i) matrix += ", " + zero;
    return text.replace(text.find("velocity: [1, 0, 0]"), 19, matrix + "]");
  };
  const std::string what = "net.yaml:10: 'covariance' of entry 1 of 'targets' ";
  EXPECT_EQ(complaint_about(with("[1, 0.5, 0, 0, 0, 0]", "[0.5, 1, 0, 0, 0, 0]")), "");
  EXPECT_EQ(complaint_about(with("[1, 1, 0, 0, 0, 0]", "[1, 1, 0, 0, 0, 0]")), "");  // one direction only
  EXPECT_EQ(complaint_about(with("[1, 0.5, 0, 0, 0, 0]", "[0.25, 1, 0, 0, 0, 0]")),
            what + "is not symmetric: row 1, column 2 is 0.5, the other way round 0.25");
  const std::string negative =
      what + "is not positive semidefinite, expected the covariance of (position, velocity)";
  EXPECT_EQ(complaint_about(with("[1, 1.1, 0, 0, 0, 0]", "[1.1, 1, 0, 0, 0, 0]")), negative);
  EXPECT_EQ(complaint_about(with("[-1, 0, 0, 0, 0, 0]", "[0, 1, 0, 0, 0, 0]")), negative);
  EXPECT_EQ(complaint_about(with("[0, 0.1, 0, 0, 0, 0]", "[0.1, 1, 0, 0, 0, 0]")), negative);
}

}  // namespace
}  // namespace seine::io
