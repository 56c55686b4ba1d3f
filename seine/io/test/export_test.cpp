#include "seine/io/export.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "seine/base/error.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/svg.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;

/// Two cars on straight metres in x: car a in 2 s, car "b, c" backwards in 1 s after a wait of 0.5 s.
struct Team {
  world::Scenario scenario;
  traj::TeamTrajectory plan;

  Team() {
    scenario.name = "a <b> & c";
    scenario.bounds = {{-10, -10}, {10, 10}};
    vehicle::Model car;
    car.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
    scenario.models = {car};
    scenario.robots = {{.name = "a", .start = {}, .goal = geom::Pose2{1, 0, 0}},
                       {.name = "b, c", .start = {0, 2, 0}, .goal = geom::Pose2{-1, 2, 0}}};
    plan.robots = {straight(0, 1, 0, 2), straight(2, -1, 0.5, 1)};
  }

  static traj::RobotTrajectory straight(double y, int gear, double wait, double duration) {
    traj::Segment segment;
    segment.gear = gear;
    segment.wait = wait;
    segment.piece_duration = duration;
    segment.curve = {{traj::Quintic{0, double(gear), 0, 0, 0, 0}, traj::Quintic{y, 0, 0, 0, 0, 0}}};
    segment.progress = {traj::Quintic{0, 0, 0, 10, -15, 6}};
    return {{segment}};
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Export, CsvHasEveryRobotOnTheCommonClock) {
  const Team team;
  const std::vector<std::string> lines = lines_of(states_csv(team.scenario, team.plan, 2.0));
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines[0], "robot,t,x,y,heading,speed,acceleration,steering");
  EXPECT_EQ(lines[1], "a,0,0,0,0,0,0,0");
  EXPECT_EQ(lines[3], "a,1,0.5,0,0,0.9375,0,0");
  EXPECT_EQ(lines[5], "a,2,1,0,0,0,0,0");
  // Half way at t = 1, backwards; at its goal since t = 1.5.
  EXPECT_EQ(lines[8].substr(0, 21), "\"b, c\",1,-0.5,2,0,-1.");
  EXPECT_EQ(lines[10].substr(0, 13), "\"b, c\",2,-1,2");
}

TEST(Export, ARateThatDoesNotDivideTheMakespanEndsOnIt) {
  const Team team;
  const std::vector<std::string> lines = lines_of(states_csv(team.scenario, team.plan, 0.7));
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[3].substr(0, 6), "a,2,1,");
}

TEST(Export, TumHoldsAQuaternion) {
  Team team;
  const std::vector<std::string> lines = lines_of(states_tum(team.plan.robots[0], 2.0, 1.0));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1], "1 0.5 0 0 0 0 0 1");
}

TEST(Export, ScheduleTurnsYawClockwise) {
  Team team;
  team.plan.robots[0].segments[0].curve[0] = {traj::Quintic{}, traj::Quintic{0, 1, 0, 0, 0, 0}};
  const std::string text = clmapf_schedule(team.scenario, team.plan, 1.0);
  EXPECT_EQ(text.rfind("statistics:\n  cost: 3.5\n  makespan: 2\n  flowtime: 3.5\n  runtime: 0\nschedule:\n  "
                       "a:\n    - x: 0\n",
                       0),
            0U)
      << text;
  EXPECT_NE(text.find("yaw: -1.5707963267948966\n      t: 0"), std::string::npos) << text;
  EXPECT_NE(text.find("  \"b, c\":\n"), std::string::npos);
  EXPECT_NE(text.find("t: 2\n"), std::string::npos);
  EXPECT_EQ(text.find("t: 3\n"), std::string::npos);
}

TEST(Export, GoesByTheEndingAndRefusesNonsense) {
  const Team team;
  const fs::path folder = fs::temp_directory_path() / "seine-export-test";
  fs::create_directories(folder);
  const std::vector<fs::path> written = export_plan(team.scenario, team.plan, 10, folder / "out.tum");
  EXPECT_EQ(written, (std::vector<fs::path>{folder / "out-a.tum", folder / "out-b__c.tum"}));
  for (const fs::path& file : written) EXPECT_TRUE(fs::exists(file));
  EXPECT_EQ(export_plan(team.scenario, team.plan, 10, folder / "out.csv").size(), 1U);
  EXPECT_THROW(export_plan(team.scenario, team.plan, 10, folder / "out.xls"), InputError);
  EXPECT_THROW(export_plan(team.scenario, team.plan, 0, folder / "out.csv"), InputError);
  EXPECT_THROW(export_plan(team.scenario, team.plan, std::nan(""), folder / "out.csv"), InputError);
  EXPECT_THROW(export_plan(team.scenario, team.plan, 1e12, folder / "out.csv"), InputError);
  fs::remove_all(folder);
}

TEST(FileBytes, WritesAllOrNothing) {
  const fs::path folder = fs::temp_directory_path() / "seine-file-test";
  fs::create_directories(folder);
  write_file(folder / "a", "one");
  write_file(folder / "a", "two");
  EXPECT_EQ(read_file(folder / "a", 10), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);  // no draft stays behind
  fs::create_symlink("a", folder / "link");
  write_file(folder / "link", "three");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "a", 10), "three");
  EXPECT_THROW(read_file(folder / "a", 4), InputError);
  EXPECT_THROW(read_file(folder / "none", 4), InputError);
  EXPECT_THROW(read_file(folder, 4), InputError);
  EXPECT_THROW(write_file(folder, "x"), InputError);
  EXPECT_THROW(write_file(folder / "no" / "such" / "folder", "x"), InputError);
  fs::remove_all(folder);
}

TEST(Svg, IsCompleteAndSmall) {
  Team team;
  team.scenario.map =
      geom::OccupancyGrid{2000, 2000, 0.01, {-10, -10, 0}, std::vector<std::uint8_t>(4'000'000, 1)};
  team.scenario.obstacles = {
      {.name = "o", .shape = world::Circle{{0, 0}, 0.3}, .motion = {{0, {0, 0, 0}}, {3, {1, 1, 1}}}}};
  for (const traj::TeamTrajectory* plan :
       std::initializer_list<const traj::TeamTrajectory*>{&team.plan, nullptr}) {
    const std::string svg = svg_text(team.scenario, plan);
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_NE(svg.find("a &lt;b&gt; &amp; c"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_LT(svg.size(), 200'000U);
  }
  EXPECT_NE(svg_text(team.scenario, &team.plan).find("backward"), std::string::npos);
  EXPECT_EQ(svg_text(team.scenario, nullptr).find("makespan"), std::string::npos);
}

}  // namespace
}  // namespace seine::io
