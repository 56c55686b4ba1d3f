// seine simulate: plans that are driven, and what it says of them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

using nlohmann::json;

// A throw and its plan, in the scratch folder.
void plan_a_throw(const Scratch& scratch) {
  ASSERT_EQ(scratch.run("generate throw --robots 4 --seed 3 -o s.yaml").status, 0);
  ASSERT_EQ(scratch.run("plan s.yaml --threads 1 -o p.json").status, 0);
}

TEST(Simulate, CatchesAndDeliversAndSaysSo) {
  const Scratch scratch;
  plan_a_throw(scratch);
  const Outcome outcome = scratch.run("simulate s.yaml p.json --noise low --replan --json");
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const json answer = json::parse(outcome.out);
  EXPECT_TRUE(answer.at("certified").get<bool>());
  EXPECT_TRUE(answer.at("caught").get<bool>());
  EXPECT_TRUE(answer.at("delivered").get<bool>());
  EXPECT_LT(answer.at("tracking_rms_m").get<double>(), 0.03);
  EXPECT_GE(answer.at("replans").get<int>(), 0);
  EXPECT_GT(answer.at("real_time_factor").get<double>(), 0.0);
  for (const char* key : {"makespan_s", "distance_m", "acceleration_cost", "catch", "certify_s"})
    EXPECT_TRUE(answer.contains(key)) << key;
  EXPECT_EQ(answer.at("outcomes").at(0).at("fate"), "caught");

  const Outcome people = scratch.run("simulate s.yaml p.json --noise low");
  EXPECT_EQ(people.status, 0);
  EXPECT_EQ(people.out.find("DELIVERED"), 0u) << people.out;
  EXPECT_EQ(people.err, "");
}

TEST(Simulate, PlansFirstWhereThereIsNoPlan) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome outcome = scratch.run("simulate s.yaml --json");
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const json answer = json::parse(outcome.out);
  EXPECT_TRUE(answer.at("delivered").get<bool>());
  EXPECT_FALSE(answer.contains("caught"));  // nothing to catch
  EXPECT_GT(answer.at("compute_s").get<double>(), 0.0);
}

TEST(Simulate, NeverDrivesWhatIsNotCertified) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  ASSERT_EQ(scratch.run("plan s.yaml -o p.json").status, 0);
  scratch.write("moved.yaml", two_cars_elsewhere());
  const Outcome outcome = scratch.run("simulate moved.yaml p.json --log d.csv");
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_EQ(outcome.out.find("REFUTED"), 0u) << outcome.out;
  EXPECT_FALSE(scratch.has("d.csv"));
  const json answer = json::parse(scratch.run("simulate moved.yaml p.json --json").out);
  EXPECT_FALSE(answer.at("certified").get<bool>());
  EXPECT_NE(answer.at("reason").get<std::string>(), "");
  EXPECT_FALSE(answer.contains("delivered"));
}

TEST(Simulate, TheSameSeedGivesTheSameLog) {
  const Scratch scratch;
  plan_a_throw(scratch);
  for (const char* name : {"a.csv", "b.csv", "a.mcap"})
    EXPECT_EQ(scratch.run(std::string("simulate s.yaml p.json --noise high --seed 4 --log ") + name).err, "");
  EXPECT_EQ(scratch.read("a.csv"), scratch.read("b.csv"));
  EXPECT_GT(scratch.read("a.csv").size(), 10000u);
  EXPECT_EQ(scratch.read("a.mcap").substr(1, 4), "MCAP");
}

TEST(Simulate, FaultsAreToldAndEndInNo) {
  const Scratch scratch;
  plan_a_throw(scratch);
  const Outcome broken = scratch.run("simulate s.yaml p.json --noise low --fault breakdown:car2@0.7");
  EXPECT_EQ(broken.status, 1) << broken.out;
  EXPECT_NE(broken.out.find("car2 does not answer: the team stops"), std::string::npos) << broken.out;
  const Outcome harmless = scratch.run(
      "simulate s.yaml p.json --noise low --replan --fault lost-fix:car1@0.5 --fault failed-mpc:car0@1 "
      "--fault late-replan@0.3+0.4 --fault target-jump@0.8+0.05=0.4,-0.3,0");
  EXPECT_EQ(harmless.status, 0) << harmless.out << harmless.err;
  EXPECT_NE(harmless.out.find("too late"), std::string::npos) << harmless.out;
}

}  // namespace
}  // namespace seine::tests
