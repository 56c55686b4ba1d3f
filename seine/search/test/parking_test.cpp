#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "seine/base/deadline.hpp"
#include "seine/search/test/path_check.hpp"

namespace seine::search {
namespace {

/// A case of data/parking_tpcap (format: SOURCES.md there). Repeated vertices are dropped.
world::Scenario parking_case(int number) {
  std::ifstream file(std::string(SEINE_DATA_DIR) + "/parking_tpcap/Case" + std::to_string(number) + ".csv");
  std::vector<double> values;
  for (std::string cell; std::getline(file, cell, ',');) values.push_back(std::stod(cell));
  world::Scenario scenario;
  scenario.models = {vehicle::tpcap_car()};
  scenario.margins = {0.0, 0.0};
  world::Robot car;
  car.start = {values.at(0), values.at(1), geom::wrap_angle(values.at(2))};
  car.goal = geom::Pose2{values.at(3), values.at(4), geom::wrap_angle(values.at(5))};
  scenario.robots = {car};
  geom::Box ends;
  ends.include(car.start.position());
  ends.include(car.goal->position());
  scenario.bounds = ends.inflated(8.0);
  const auto count = static_cast<std::size_t>(values.at(6));
  std::size_t at = 7 + count;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<geom::Vec2> polygon;
    for (auto left = static_cast<int>(values.at(7 + i)); left > 0; --left, at += 2) {
      const geom::Vec2 vertex{values.at(at), values.at(at + 1)};
      if (polygon.empty() || !(polygon.back() == vertex)) polygon.push_back(vertex);
    }
    while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
    world::Obstacle obstacle;
    obstacle.shape = polygon;
    scenario.obstacles.push_back(obstacle);
  }
  return scenario;
}

class Parking : public testing::TestWithParam<int> {};

TEST_P(Parking, ASoundPathIsFound) {
  const auto scenario = parking_case(GetParam());
  const world::StaticMap map(scenario);
  const PathPlanner planner(map, scenario.models[0]);
  PathOptions options;
  options.clearance = 0.0;
  const Stopwatch watch;
  const auto path = planner.plan(scenario.robots[0].start, *scenario.robots[0].goal, options);
  RecordProperty("milliseconds", std::to_string(1e3 * watch.seconds()));
  ASSERT_TRUE(path);
  expect_sound(*path, scenario.robots[0].start, *scenario.robots[0].goal, map, scenario.models[0], 0.0,
               0.003);
}

INSTANTIATE_TEST_SUITE_P(Cases, Parking, testing::Values(1, 3, 5, 7, 9, 11, 13, 15, 17, 19));

}  // namespace
}  // namespace seine::search
