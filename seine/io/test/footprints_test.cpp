// The footprint of a car by each format, written out by hand: corners in the car's frame, rear axle at the
// origin, x forward.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seine/io/scenario_file.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

struct Known {
  const char* format;
  std::string file, text;
  std::vector<Vec2> corners;  ///< counter-clockwise, beginning anywhere
  double wheelbase;
};

std::string native(const std::string& models) {
  return "seine: 1\nworld: {bounds: [-9, -9, 9, 9]}\n" + models +
         "robots: [{start: {x: 0, y: 0, heading: 0}, goal: {x: 1, y: 0, heading: 0}}]\n";
}

TEST(Footprints, OfEveryFormat) {
  const Known known[] = {
      {"default", "a.yaml", native(""), {{-0.1, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {-0.1, 0.2}}, 0.4},
      {"rectangle",
       "a.yaml",
       native(
           "models: {default: {footprint: {length: 4, width: 1.8, rear_overhang: 0.75}, wheelbase: 2.5}}\n"),
       {{-0.75, -0.9}, {3.25, -0.9}, {3.25, 0.9}, {-0.75, 0.9}},
       2.5},
      {"axle behind the car",
       "a.yaml",
       native("models: {default: {footprint: {length: 2, width: 1, rear_overhang: -0.5}}}\n"),
       {{0.5, -0.5}, {2.5, -0.5}, {2.5, 0.5}, {0.5, 0.5}},
       0.4},
      {"polygon, clockwise and closed",
       "a.yaml",
       native("models: {default: {footprint: {polygon: [[-1, -1], [-1, 1], [2, 0], [-1, -1]]}}}\n"),
       {{-1, -1}, {2, 0}, {-1, 1}},
       0.4},
      {"CL-MAPF",
       "a.yaml",
       "agents:\n- start: [10, 10, 0]\n  goal: [20, 10, 0]\n  name: agent0\nmap:\n  dimensions: [50, 50]\n  "
       "obstacles:\n",
       {{-1, -1}, {2, -1}, {2, 1}, {-1, 1}},
       NAN},
      {"TPCAP",
       "a.csv",
       "0,0,0,5,0,0,0\n",
       {{-0.929, -0.971}, {3.76, -0.971}, {3.76, 0.971}, {-0.929, 0.971}},
       2.8},
  };
  for (const Known& one : known) {
    SCOPED_TRACE(one.format);
    const world::Scenario scenario = parse_scenario(one.text, one.file, ".");
    const vehicle::Model& model = scenario.model_of(scenario.robots[0]);
    ASSERT_EQ(model.footprint.size(), one.corners.size());
    const auto near = [](Vec2 a, Vec2 b) { return geom::norm(a - b) < 1e-9; };
    std::vector<Vec2> turned = one.corners;
    for (std::size_t i = 0; i < turned.size() && !near(turned[0], model.footprint[0]); ++i)
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    for (std::size_t i = 0; i < turned.size(); ++i)
      EXPECT_TRUE(near(turned[i], model.footprint[i]))
          << i << ": " << model.footprint[i].x << ", " << model.footprint[i].y;
    if (!std::isnan(one.wheelbase)) {
      EXPECT_EQ(model.wheelbase, one.wheelbase);
    }
  }
}

}  // namespace
}  // namespace seine::io
