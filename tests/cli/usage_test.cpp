#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

TEST(Usage, HelpTeaches) {
  const Scratch scratch;
  const Outcome help = scratch.run("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* word : {"plan", "certify", "check", "simulate", "plot", "export", "generate", "bench",
                           "Examples", "Exit status"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(help.err, "");
  for (const char* command :
       {"plan", "certify", "simulate", "plot", "export", "generate", "bench", "check"}) {
    const Outcome more = scratch.run(std::string(command) + " --help");
    EXPECT_EQ(more.status, 0) << command;
    EXPECT_NE(more.out.find("Example"), std::string::npos) << command;
  }
}

TEST(Usage, VersionIsOneLine) {
  const Outcome version = Scratch().run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(is_one_line(version.out)) << version.out;
}

/// Wrong command lines: status 2, one line on stderr, nothing on stdout, at once.
class WrongUsage : public testing::TestWithParam<const char*> {};

TEST_P(WrongUsage, IsOneLineAndStatusTwo) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  const Outcome outcome = scratch.run(GetParam());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_LT(outcome.seconds, 1.0 * patience());
}

INSTANTIATE_TEST_SUITE_P(
    Cli, WrongUsage,
    testing::Values(
        "", "paln s.yaml", "plan", "plan s.yaml --frobnicate", "plan s.yaml --deadline 0",
        "plan s.yaml --deadline -1", "plan s.yaml --deadline nan", "plan s.yaml --deadline soon",
        "plan s.yaml --threads -1", "plan s.yaml --threads 1e9", "plan s.yaml --seed -4",
        "plan s.yaml --seed x", "plan s.yaml --method magic", "plan s.yaml --cusp-speed 0.1",
        "plan s.yaml --method letter --cusp-speed 0", "plan s.yaml --method letter --cusp-speed 1e9",
        "plan s.yaml -o no/such/folder/plan.json", "plan s.yaml -o .", "plan missing.yaml", "plan .",
        "plan s.yaml s.yaml", "certify s.yaml", "certify s.yaml missing.json", "certify s.yaml s.yaml",
        "plot s.yaml", "plot s.yaml missing.json -o a.svg", "export s.yaml missing.json",
        "export s.yaml missing.json --rate 0 -o a.csv", "generate", "generate rondom",
        "generate random --robots 0", "generate random --robots -3", "generate random --robots 1000000000",
        "generate random --robots three", "generate swap --obstacles 4", "generate random --obstacles -1",
        "generate map", "generate map --map s.yaml", "generate random --map s.yaml", "bench",
        "bench --family rondom", "bench missing.yaml --seeds 0", "bench --reference missing.csv s.yaml",
        "view s.yaml", "simulate", "simulate missing.yaml", "simulate s.yaml missing.json",
        "simulate s.yaml --noise loud", "simulate s.yaml --log drive.txt",
        "simulate s.yaml --log no/such/folder/drive.csv", "simulate s.yaml --fault",
        "simulate s.yaml --fault earthquake@1", "simulate s.yaml --fault breakdown:nobody@1",
        "simulate s.yaml --fault breakdown:left", "simulate s.yaml --fault breakdown:left@soon",
        "simulate s.yaml --fault breakdown:left@1+1", "simulate s.yaml --fault lost-fix:left@1+-1",
        "simulate s.yaml --fault late-replan:left@1", "simulate s.yaml --fault target-jump@1=1,0,0"));

TEST(Usage, GenerateIsDeterministicAndLoads) {
  const Scratch scratch;
  for (const std::string family : {"random", "swap", "corridor", "parking", "throw", "gap"}) {
    const Outcome a = scratch.run("generate " + family + " --robots 5 --seed 3");
    EXPECT_EQ(a.status, 0) << a.err;
    EXPECT_EQ(a.out, scratch.run("generate " + family + " --robots 5 --seed 3").out);
    EXPECT_EQ(scratch.run("generate " + family + " --robots 5 --seed 3 -o s.yaml").status, 0);
    EXPECT_EQ(scratch.read("s.yaml"), a.out);
  }
}

TEST(Usage, GenerateOnAMapWritesTheMapBeside) {
  const Scratch scratch;
  const std::string map = std::string(SEINE_DATA_DIR) + "/maps/ros/skirk.yaml";
  const Outcome outcome = scratch.run("generate map --map " + map + " --robots 3 --seed 2 -o s.yaml");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(scratch.has("s.yaml"));
  EXPECT_TRUE(scratch.has("s-map.yaml"));
}

/// What is unknown is answered with what is near.
TEST(Usage, UnknownWordsAreAnsweredWithTheNearest) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  for (const auto& [command, hint] : {std::pair{"paln s.yaml", "'plan'"},
                                      {"chekc s.yaml", "'check'"},
                                      {"plan s.yaml --dedline 3", "'--deadline'"},
                                      {"plan s.yaml --method joitn", "'joint'"},
                                      {"plan s.yaml --without cach", "'catch'"},
                                      {"generate rondom", "'random'"},
                                      {"generate everyday --kind paralel", "'parallel'"},
                                      {"generate everyday --vehicle fltenth", "'f1tenth'"},
                                      {"bench --family swpa", "'swap'"},
                                      {"bench --family everyday --kind dor", "'door'"},
                                      {"simulate s.yaml --noise hihg", "'high'"},
                                      {"simulate s.yaml --fault brekdown:left@1", "'breakdown'"}}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_NE(outcome.err.find(std::string("did you mean ") + hint), std::string::npos) << outcome.err;
    EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
  }
}

/// Numbers beyond the range are refused, never cut off to it, in words that name the range.
TEST(Usage, NumbersBeyondTheRangeAreRefused) {
  const Scratch scratch;
  scratch.write("s.yaml", two_cars());
  for (const char* command :
       {"plan s.yaml --seed -1", "plan s.yaml --seed 18446744073709551616", "plan s.yaml --seed 1.5",
        "generate random --seed -1", "generate random --robots 99999999999999999999",
        "generate random --robots 2.5", "generate random --robots 0", "plan s.yaml --threads 4294967297",
        "bench s.yaml --limit 0", "bench --family swap --seeds -3", "bench --family swap --seeds 0",
        "bench --family swap --robots 2 -1", "bench s.yaml --best-of 1e2"}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 2) << command << outcome.out;
    EXPECT_NE(outcome.err.find("whole number from"), std::string::npos) << command << ": " << outcome.err;
  }
  EXPECT_EQ(scratch.run("generate random --robots 2 --seed 18446744073709551615").status, 0);
  EXPECT_EQ(scratch.run("generate everyday --robots 3").status, 2);
}

}  // namespace
}  // namespace seine::tests
