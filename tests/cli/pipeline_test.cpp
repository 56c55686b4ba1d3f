// From a task to a plan, its proof, its picture and its states.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

using nlohmann::json;

TEST(Pipeline, PlanCertifyPlotExport) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome plan = scratch.run("plan s.yaml -o p.json");
  ASSERT_EQ(plan.status, 0) << plan.out << plan.err;
  EXPECT_EQ(plan.err, "");
  EXPECT_NE(plan.out.find("CERTIFIED"), std::string::npos);

  const Outcome certify = scratch.run("certify s.yaml p.json");
  EXPECT_EQ(certify.status, 0) << certify.out << certify.err;

  const Outcome plot = scratch.run("plot s.yaml p.json -o p.svg");
  EXPECT_EQ(plot.status, 0) << plot.err;
  EXPECT_NE(scratch.read("p.svg").find("</svg>"), std::string::npos);

  const Outcome exported = scratch.run("export s.yaml p.json --rate 50 -o p.csv");
  EXPECT_EQ(exported.status, 0) << exported.err;
  EXPECT_EQ(scratch.read("p.csv").substr(0, 52), "robot,t,x,y,heading,speed,acceleration,steering\nleft");
}

TEST(Pipeline, JsonHasTheKeysScriptsRelyOn) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome plan = scratch.run("plan s.yaml --json --deadline 10 --threads 1 --seed 5 --method joint");
  ASSERT_EQ(plan.status, 0) << plan.err;
  const json answer = json::parse(plan.out);
  EXPECT_TRUE(answer.at("certified").get<bool>());
  EXPECT_EQ(answer.at("robots").get<int>(), 2);
  for (const char* key :
       {"compute_s", "guess_s", "optimise_s", "certify_s", "iterations", "makespan_s", "mean_travel_s",
        "distance_m", "acceleration_cost", "min_robot_clearance_m", "min_obstacle_clearance_m"}) {
    EXPECT_TRUE(answer.contains(key) && answer.at(key).is_number()) << key;
  }
  EXPECT_GE(answer.at("min_robot_clearance_m").get<double>(), 0.05);
}

TEST(Pipeline, TheSameInputGivesTheSameBytes) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const auto trajectories = [&](const std::string& options) {
    EXPECT_EQ(scratch.run("plan s.yaml -o p.json " + options).status, 0);
    return json::parse(scratch.read("p.json")).at("robots");
  };
  const json once = trajectories("--threads 1");
  EXPECT_EQ(trajectories("--threads 1"), once);
  EXPECT_EQ(trajectories("--threads 2"), once);
}

TEST(Pipeline, APlanForAnotherTaskIsRefuted) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  ASSERT_EQ(scratch.run("plan s.yaml -o p.json").status, 0);
  scratch.write("moved.yaml", two_cars_elsewhere());
  const Outcome outcome = scratch.run("certify moved.yaml p.json");
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_NE(outcome.out.find("left"), std::string::npos) << outcome.out;
  const Outcome answer = scratch.run("certify moved.yaml p.json --json");
  EXPECT_EQ(answer.status, 1);
  EXPECT_FALSE(json::parse(answer.out).at("certified").get<bool>());
}

TEST(Pipeline, DeadlinesAreKept) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run("generate swap --robots 50 -o s.yaml").status, 0);
  double least = 10.0;  // a busy machine may wake us late, but not every time
  for (int i = 0; i < 5; ++i) {
    const Outcome outcome = scratch.run("plan s.yaml --deadline 0.1 --json");
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.err;
    least = std::min(least, outcome.seconds);
  }
  EXPECT_LT(least, 0.08 * patience());  // the process around the plan starts, reads and prints, too
}

TEST(Pipeline, InterruptedEndsSoonAndWritesNothing) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run("generate swap --robots 300 -o s.yaml").status, 0);
  // Ctrl-C as soon as the program listens for it (bit 2 of its caught signals), long before three hundred
  // cars are planned.
  scratch.write("run.sh", SEINE_PROGRAM
                " plan s.yaml -o p.json &\n"
                "for i in $(seq 1000); do\n"
                "  grep -q '^SigCgt:.*[2367abef]$' /proc/$!/status && break || sleep 0.01\n"
                "done\n"
                "kill -INT $!; wait $!; echo $?\n");
  const Outcome outcome = scratch.run("--version && bash run.sh");
  EXPECT_EQ(outcome.err, "seine: interrupted\n");
  EXPECT_NE(outcome.out.find("130\n"), std::string::npos) << outcome.out;
  EXPECT_FALSE(scratch.has("p.json"));
  EXPECT_LT(outcome.seconds, 2.0 * patience());
}

TEST(Pipeline, ANetCatchesWhatIsThrown) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run("generate throw --robots 3 --seed 1 -o s.yaml").status, 0);
  const Outcome planned = scratch.run("plan s.yaml -o p.json --json");
  ASSERT_EQ(planned.status, 0) << planned.out << planned.err;
  for (const char* key : {"\"catch\"", "\"time_s\"", "\"margin_m\"", "\"opening\""})
    EXPECT_NE(planned.out.find(key), std::string::npos) << key;
  EXPECT_EQ(scratch.run("certify s.yaml p.json").status, 0);
  EXPECT_EQ(scratch.run("plot s.yaml p.json -o p.svg").status, 0);
  // Without what pulls the team to its target the plan misses it, and is no plan.
  const Outcome without = scratch.run("plan s.yaml --without catch -o q.json");
  EXPECT_EQ(without.status, 1);
  EXPECT_FALSE(scratch.has("q.json"));
  EXPECT_EQ(scratch.run("plan s.yaml --without everything").status, 2);
}

// The letter's own planner stands by a plan that starts and stops at 0.24 m/s; the certificate does not.
TEST(Pipeline, TheLettersMethodClaimsWhatIsNotCertified) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome plan = scratch.run("plan s.yaml --method letter --json -o p.json");
  EXPECT_EQ(plan.status, 1) << plan.err;
  EXPECT_FALSE(scratch.has("p.json"));
  const json answer = json::parse(plan.out);
  EXPECT_FALSE(answer.at("certified").get<bool>());
  EXPECT_TRUE(answer.at("claimed").get<bool>()) << plan.out;
  EXPECT_TRUE(answer.contains("makespan_s"));
  EXPECT_NE(scratch.run("plan s.yaml --method letter --cusp-speed 0.1").out.find("claims success"),
            std::string::npos);
  EXPECT_FALSE(json::parse(scratch.run("plan s.yaml --json").out).contains("claimed"));
}

TEST(Pipeline, BenchResumes) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome first = scratch.run("bench s.yaml -o b.csv");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find("1 of 1"), std::string::npos) << first.out;
  const std::string rows = scratch.read("b.csv");
  const Outcome again = scratch.run("bench s.yaml -o b.csv");
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(scratch.read("b.csv"), rows);
  EXPECT_EQ(scratch.run("bench s.yaml --deadline 3 -o b.csv").status, 2) << "other settings, same file";
}

}  // namespace
}  // namespace seine::tests
