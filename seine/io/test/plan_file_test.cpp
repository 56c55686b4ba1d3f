#include "seine/io/plan_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/io/certificate_json.hpp"
#include "seine/io/report.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

world::Scenario two_cars() {
  world::Scenario scenario;
  scenario.name = "two \"cars\"";
  scenario.bounds = {{-10, -10}, {10, 10}};
  vehicle::Model car;
  car.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
  scenario.models = {car};
  scenario.robots = {{.name = "a", .start = {}, .goal = geom::Pose2{1, 0, 0}},
                     {.name = "b", .start = {0, 2, 0}, .goal = geom::Pose2{1, 2, 0}}};
  return scenario;
}

/// A straight metre from (0, y), at rest at both ends, with numbers that need all their digits.
traj::RobotTrajectory straight(double y, Rng& rng) {
  traj::Segment segment;
  segment.wait = rng.uniform();
  segment.piece_duration = 1.0 + rng.uniform();
  segment.curve = {{traj::Quintic{0, 1, 0, 0, 0, 0}, traj::Quintic{y, 1e-17 * rng.normal(), 0, 0, 0, 0}}};
  segment.progress = {traj::Quintic{0, 0, 0, 10, -15, 6}};
  return {{segment}};
}

planner::PlanResult result_for_two() {
  Rng rng(7);
  planner::PlanResult result;
  result.certified = true;
  result.reason = "";
  result.plan.robots = {straight(0, rng), straight(1.0 / 3, rng)};
  result.plan.robots[1].segments.push_back(result.plan.robots[1].segments[0]);
  result.plan.robots[1].segments[1].gear = -1;
  result.certificate.holds = true;
  result.certificate.robots = {0.5, 1.0, 0, 1};
  return result;
}

std::string complaint_about(const std::string& text) {
  try {
    parse_plan(text, "plan.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanFile, ReadsBackTheSameBits) {
  const world::Scenario scenario = two_cars();
  const planner::PlanResult result = result_for_two();
  const fs::path path = fs::temp_directory_path() / "seine-plan-test.json";
  save_plan(scenario, result, path);
  const PlanFile read = load_plan(path);
  fs::remove(path);
  EXPECT_EQ(read.scenario, scenario.name);
  EXPECT_EQ(read.robots, (std::vector<std::string>{"a", "b"}));
  EXPECT_NO_THROW(expect_same_team(scenario, read, "plan.json"));
  ASSERT_EQ(read.plan.robots.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(read.plan.robots[k].segments.size(), result.plan.robots[k].segments.size());
    for (std::size_t i = 0; i < read.plan.robots[k].segments.size(); ++i) {
      const traj::Segment &a = read.plan.robots[k].segments[i], &b = result.plan.robots[k].segments[i];
      EXPECT_EQ(a.gear, b.gear);
      EXPECT_EQ(a.wait, b.wait);
      EXPECT_EQ(a.piece_duration, b.piece_duration);
      EXPECT_EQ(a.curve, b.curve);
      EXPECT_EQ(a.progress, b.progress);
    }
  }
}

TEST(PlanFile, ACarThatStandsHasOnePose) {
  planner::PlanResult result = result_for_two();
  const geom::Pose2 pose{1.0 / 3, 2e-17, -0.1};
  result.plan.robots[1] = traj::RobotTrajectory::standing(pose);
  const std::string text = plan_text(two_cars(), result);
  const PlanFile read = parse_plan(text, "plan.json");
  EXPECT_FALSE(read.plan.robots[0].stands);
  ASSERT_TRUE(read.plan.robots[1].stands);
  EXPECT_EQ(*read.plan.robots[1].stands, pose);
  EXPECT_EQ(read.plan.robots[1].arrival(), 0.0);
  EXPECT_EQ(read.plan.robots[1].at(3.0).pose, pose);
  const json robot = json::parse(text)["robots"][1];
  EXPECT_EQ(robot["arrival_s"], 0);
  EXPECT_EQ(robot["segments"].size(), 0U);
  EXPECT_EQ(robot["states"].size(), 1U);
}

TEST(PlanFile, SaysWhatItWasMadeFor) {
  world::Scenario scenario = two_cars();
  const std::string text = plan_text(scenario, result_for_two());
  PlanFile read = parse_plan(text, "plan.json");
  EXPECT_EQ(changed_since(scenario, read), std::vector<std::string>{});
  scenario.models[0].wheelbase *= 2.0;
  scenario.margins.robot = 0.3;
  EXPECT_EQ(changed_since(scenario, read), (std::vector<std::string>{"models", "margins"}));
  const json said = json::parse(report_json(scenario, certify::Certificate{}, changed_since(scenario, read)));
  EXPECT_EQ(said["made_for_this"], false);
  EXPECT_EQ(said["changed_since"], (json{"models", "margins"}));

  json plan = json::parse(text);
  plan.erase("made_for");
  read = parse_plan(plan.dump(), "plan.json");
  EXPECT_EQ(changed_since(scenario, read), std::nullopt);
  EXPECT_TRUE(json::parse(report_json(scenario, certify::Certificate{}))["made_for_this"].is_null());
  plan["made_for"] = {{"robots", "12"}};
  EXPECT_EQ(complaint_about(plan.dump()),
            "plan.json: made_for.robots is no fingerprint, expected 16 hexadecimal digits");
}

TEST(PlanFile, StatesAreSampledAtTwentyHertzUpToTheArrival) {
  const planner::PlanResult result = result_for_two();
  const json plan = json::parse(plan_text(two_cars(), result));
  EXPECT_EQ(plan["state_columns"].size(), 7U);
  const json& states = plan["robots"][0]["states"];
  const double arrival = result.plan.robots[0].arrival();
  EXPECT_EQ(states.size(), static_cast<std::size_t>(std::ceil(arrival * 20)) + 1);
  EXPECT_NEAR(states[1][0].get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(states.back()[0].get<double>(), arrival, 1e-6);
  EXPECT_NEAR(states.back()[1].get<double>(), 1.0, 1e-6);
  EXPECT_TRUE(plan["certificate"]["holds"].get<bool>());
}

TEST(PlanFile, MistakesAreNamed) {
  const std::string good = plan_text(two_cars(), result_for_two());
  EXPECT_EQ(complaint_about(good), "");
  const auto edited = [&](auto&& edit) {
    json plan = json::parse(good);
    edit(plan);
    return complaint_about(plan.dump());
  };
  const auto segment = [](json& plan) -> json& { return plan["robots"][1]["segments"][0]; };
  EXPECT_EQ(edited([](json& p) { p.erase("robots"); }),
            "plan.json: the file has no 'robots', which is required");
  EXPECT_EQ(edited([](json& p) { p["seine_plan"] = 2; }),
            "plan.json: seine_plan is a format this version cannot read, expected 1");
  EXPECT_EQ(edited([](json& p) { p.erase("seine_plan"); }),
            "plan.json:1: is no plan, expected \"seine_plan\": 1");
  EXPECT_EQ(edited([&](json& p) { segment(p)["gear"] = 0; }),
            "plan.json: robots[1].segments[0].gear is no gear, expected 1 or -1");
  EXPECT_EQ(edited([&](json& p) { segment(p)["wait"] = -1; }),
            "plan.json: robots[1].segments[0].wait is -1, expected 0 to 1e+06");
  EXPECT_EQ(edited([&](json& p) { segment(p)["curve"][0][1].push_back(1); }),
            "plan.json: robots[1].segments[0].curve[0][1] has 7 entries, expected 6");
  EXPECT_EQ(edited([&](json& p) { segment(p)["progress"][0][2] = "x"; }),
            "plan.json: robots[1].segments[0].progress[0][2] is of type string, expected a number");
  EXPECT_EQ(edited([](json& p) { p["robots"][0].erase("states"); }), "");
}

TEST(PlanFile, HostileJsonGivesOneLine) {
  EXPECT_EQ(complaint_about("{\n\"seine_plan\": 1,\n}"), "plan.json:3: is not valid JSON");
  EXPECT_EQ(complaint_about(""), "plan.json:1: is not valid JSON");
  EXPECT_EQ(complaint_about("[1]"), "plan.json: the file is of type array, expected an object");
  EXPECT_EQ(complaint_about("{\"seine_plan\": NaN}"), "plan.json:1: is not valid JSON");
  EXPECT_EQ(complaint_about("{\"seine_plan\": 1e999}"),
            "plan.json: is not valid JSON: a number is too large");
  EXPECT_EQ(complaint_about(std::string(1000000, '[')), "plan.json:1: is nested too deeply to be a plan");
}

TEST(PlanFile, AnotherTeamIsRefused) {
  PlanFile plan;
  plan.robots = {"a"};
  EXPECT_THROW(expect_same_team(two_cars(), plan, "p.json"), InputError);
  plan.robots = {"a", "c"};
  EXPECT_THROW(expect_same_team(two_cars(), plan, "p.json"), InputError);
}

TEST(Report, HasTheDocumentedKeys) {
  const json report = json::parse(report_json(two_cars(), result_for_two()));
  for (const char* key :
       {"certified", "reason", "robots", "compute_s", "guess_s", "optimise_s", "certify_s", "iterations",
        "makespan_s", "mean_travel_s", "distance_m", "acceleration_cost", "min_robot_clearance_m"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  // Nothing was near: no number stands for it.
  EXPECT_FALSE(report.contains("min_obstacle_clearance_m"));
  planner::PlanResult failed;
  failed.reason = "no way \xff for car0";
  const json no = json::parse(report_json(two_cars(), failed));
  EXPECT_FALSE(no["certified"].get<bool>());
  EXPECT_FALSE(no.contains("makespan_s"));
}

TEST(Report, CatchesAreThereWhereTheyAreAskedFor) {
  certify::Certificate certificate;
  certificate.catches = {{.time = 1.5, .rim_margin = 0.4, .opening = 0.9}};
  json report = json::parse(report_json(two_cars(), certificate));
  EXPECT_EQ(report["catch"]["time_s"], 1.5);
  EXPECT_EQ(report["catch"]["margin_m"], 0.4);
  EXPECT_EQ(report["catch"]["opening"], 0.9);
  EXPECT_FALSE(report.contains("catches"));
  // Of several, the one with the smallest margin stands for all; one that never comes is worse than any.
  certificate.catches.push_back({.time = 3.0, .rim_margin = 0.25, .opening = 0.89});
  certificate.catches.push_back({.time = 4.0, .rim_margin = 0.3, .opening = 0.93});
  report = json::parse(report_json(two_cars(), certificate));
  EXPECT_EQ(report["catch"]["time_s"], 3.0);
  ASSERT_EQ(report["catches"].size(), 3u);
  EXPECT_EQ(report["catches"][2]["margin_m"], 0.3);
  const double never = std::numeric_limits<double>::quiet_NaN();
  certificate.catches[0] = {never, never, never, never, never, never, never, never};
  report = json::parse(report_json(two_cars(), certificate));
  EXPECT_TRUE(report["catch"]["time_s"].is_null());
  EXPECT_FALSE(json::parse(report_json(two_cars(), certify::Certificate{})).contains("catch"));
}

TEST(Report, WhatIsLeftOfANet) {
  certify::Certificate certificate;
  world::Scenario scenario = two_cars();
  EXPECT_FALSE(json::parse(certificate_json(scenario, certificate)).contains("net_ground"));
  scenario.net = net::Net{};
  certificate.net.ground = {0.125, 2.0, -1, -1};
  certificate.net.stretch = {0.5, 1.0, 0, 1};
  const json inside = json::parse(certificate_json(scenario, certificate));
  EXPECT_EQ(inside["net_ground"]["clearance"], 0.125);
  EXPECT_EQ(inside["net_stretch"]["other"], "b");
  EXPECT_TRUE(inside["net_obstacles"]["clearance"].is_null());
  const json report = json::parse(report_json(scenario, certificate));
  EXPECT_EQ(report["min_net_clearance_m"], 0.125);
  EXPECT_EQ(report["min_net_stretch_margin_m"], 0.5);
}

TEST(Report, AVerdictListsWhatIsBroken) {
  certify::Certificate certificate;
  certificate.violations = {{certify::Kind::robot_clearance, 1.5, 0, 1, 0.01, 0.05, "a comes too near to b"}};
  const json report = json::parse(report_json(two_cars(), certificate));
  EXPECT_FALSE(report["certified"].get<bool>());
  EXPECT_EQ(report["reason"], "a comes too near to b");
  EXPECT_EQ(report["violations"][0]["robot"], "a");
  EXPECT_EQ(report["violations"][0]["other"], "b");
  EXPECT_EQ(json::parse(failure_json("a: b"))["error"], "a: b");
}

}  // namespace
}  // namespace seine::io
