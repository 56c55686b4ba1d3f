// The user's files: nothing that is read is written over, nothing is left half written, nothing is lost.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "tests/cli/program.hpp"

namespace seine::tests {
namespace {

namespace fs = std::filesystem;

// A task with a map, an import, a car model and a plan, under many names.
class Sacred : public testing::Test {
 protected:
  void SetUp() override {
    scratch.write("task.yaml", two_cars());
    scratch.write("outer.yaml", "seine: 1\nimport: task.yaml\n");
    scratch.write("car.yaml", "wheelbase: 0.4\n");
    std::string picture = "P5\n100 30\n255\n" + std::string(100 * 30, '\xfe');
    scratch.write("m.pgm", picture);
    scratch.write("m.yaml",
                  "image: m.pgm\nresolution: 0.1\norigin: [-5, -1.5, 0]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.2\n");
    std::string mapped = two_cars();
    const std::string bounds = "bounds: [-5, -1.5, 5, 1.5]";
    mapped.replace(mapped.find(bounds), bounds.size(), "map: m.yaml");
    scratch.write("mapped.yaml", mapped);
    ASSERT_EQ(scratch.run("plan task.yaml -o p.json").status, 0);
    fs::create_hard_link(scratch.folder() / "task.yaml", scratch.folder() / "hard.yaml");
    fs::create_symlink("task.yaml", scratch.folder() / "soft.yaml");
    fs::create_hard_link(scratch.folder() / "m.pgm", scratch.folder() / "m-hard.svg");
    fs::create_hard_link(scratch.folder() / "p.json", scratch.folder() / "p-hard.csv");
    fs::create_hard_link(scratch.folder() / "task.yaml", scratch.folder() / "task-hard.csv");
    for (const auto& entry : fs::directory_iterator(scratch.folder()))
      if (const std::string name = entry.path().filename().string(); !name.starts_with("."))
        before.insert({name, scratch.read(name)});
  }
  Scratch scratch;
  std::set<std::pair<std::string, std::string>> before;
};

TEST_F(Sacred, NoOutputReplacesAnInput) {
  for (const char* command : {"plan task.yaml -o task.yaml",
                              "plan task.yaml -o ./task.yaml",
                              "plan ./task.yaml -o hard.yaml",
                              "plan task.yaml -o soft.yaml",
                              "plan soft.yaml -o hard.yaml",
                              "plan outer.yaml -o task.yaml",
                              "plan mapped.yaml -o m.yaml",
                              "plan mapped.yaml -o m.pgm",
                              "plan mapped.yaml -o m-hard.svg",
                              "plan task.yaml --model car.yaml -o car.yaml",
                              "plot task.yaml -o task.yaml",
                              "plot task.yaml p.json -o p.json",
                              "plot mapped.yaml -o m-hard.svg",
                              "export task.yaml p.json -o task-hard.csv",
                              "export task.yaml p.json -o p-hard.csv",
                              "simulate task.yaml p.json --log p-hard.csv",
                              "simulate task.yaml --log task-hard.csv",
                              "generate map --map m.yaml --robots 2 -o m.yaml",
                              "generate map --map m.yaml --robots 2 -o m.pgm",
                              "bench task.yaml -o task.yaml",
                              "bench task.yaml -o hard.yaml",
                              "bench --map m.yaml -o m.pgm",
                              "plan - <task.yaml -o task.yaml",
                              "plan task.yaml --json 1<>task.yaml"}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 2) << command << outcome.out;
    EXPECT_TRUE(is_one_line(outcome.err)) << command << ": " << outcome.err;
  }
  for (const auto& [name, text] : before) EXPECT_EQ(scratch.read(name), text) << name;
}

TEST_F(Sacred, GeneratedMapsReplaceNothingTheyAreMadeOf) {
  fs::rename(scratch.folder() / "m.yaml", scratch.folder() / "t-map.yaml");
  const Outcome outcome = scratch.run("generate map --map t-map.yaml --robots 2 -o t.yaml");
  EXPECT_EQ(outcome.status, 2) << outcome.out;
  EXPECT_FALSE(scratch.has("t.yaml"));
}

TEST_F(Sacred, NoNameIsNoWish) {
  for (const char* command : {"plan task.yaml -o ''", "plot task.yaml -o ''", "export task.yaml p.json -o ''",
                              "simulate task.yaml p.json --log ''", "generate random -o ''",
                              "bench task.yaml -o ''", "plot task.yaml -o picture.png"}) {
    const Outcome outcome = scratch.run(command);
    EXPECT_EQ(outcome.status, 2) << command << outcome.out;
    EXPECT_TRUE(is_one_line(outcome.err)) << command << ": " << outcome.err;
  }
}

TEST_F(Sacred, ReplacedFilesKeepModeAndNames) {
  const fs::path file = scratch.folder() / "p.json";
  fs::remove(scratch.folder() / "p-hard.csv");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("p.json", scratch.folder() / "latest.json");
  scratch.write("p.json", "old");
  ASSERT_EQ(scratch.run("plan task.yaml -o latest.json").status, 0);
  EXPECT_TRUE(fs::is_symlink(scratch.folder() / "latest.json"));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_NE(scratch.read("p.json").find("seine_plan"), std::string::npos);
  fs::create_hard_link(file, scratch.folder() / "q.json");
  for (const char* old : {"old", "and one that is longer than any plan will ever be"}) {
    std::string content;
    for (int i = 0; i < 5000; ++i) content += old;
    scratch.write("p.json", content);
    ASSERT_EQ(scratch.run("plan task.yaml -o p.json").status, 0);
    EXPECT_EQ(fs::hard_link_count(file), 2u);
    EXPECT_EQ(scratch.read("q.json"), scratch.read("p.json"));
    EXPECT_TRUE(nlohmann::json::accept(scratch.read("p.json")));
  }
  fs::create_symlink("not-there-yet.json", scratch.folder() / "dangling.json");
  ASSERT_EQ(scratch.run("plan task.yaml -o dangling.json").status, 0);
  EXPECT_TRUE(fs::is_symlink(scratch.folder() / "dangling.json"));
  EXPECT_TRUE(scratch.has("not-there-yet.json"));
}

TEST_F(Sacred, AFullDiskIsAnErrorEverywhere) {
  for (const char* command : {"--help >/dev/full",
                              "--version >/dev/full",
                              "plan --help >/dev/full",
                              "plan task.yaml >/dev/full",
                              "plan task.yaml --json >/dev/full",
                              "plan task.yaml -o /dev/full",
                              "plan task.yaml -o - >/dev/full",
                              "certify task.yaml p.json >/dev/full",
                              "certify task.yaml p.json --json >/dev/full",
                              "simulate task.yaml p.json >/dev/full",
                              "simulate task.yaml p.json --json >/dev/full",
                              "plot task.yaml -o /dev/full",
                              "export task.yaml p.json -o - >/dev/full",
                              "generate random --robots 3 >/dev/full",
                              "generate random -o /dev/full",
                              "bench task.yaml >/dev/full",
                              "bench task.yaml -o /dev/full",
                              "plan nothing.yaml --json >/dev/full",
                              "check task.yaml >/dev/full",
                              "check task.yaml --json >/dev/full"}) {
    const Outcome outcome = scratch.run_in_shell(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_TRUE(is_one_line(outcome.err) || outcome.err.find("CERTIFIED") == 0) << command << outcome.err;
    EXPECT_NE(outcome.err.find("seine: "), std::string::npos) << command << outcome.err;
  }
}

TEST_F(Sacred, ATooSmallQuotaLeavesTheOldFileAndNoOther) {
  scratch.write("out.json", "precious\n");
  const Outcome outcome = scratch.run_in_shell("plan task.yaml -o out.json", "ulimit -f 4;");
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(scratch.read("out.json"), "precious\n");
  for (const auto& entry : fs::directory_iterator(scratch.folder()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST_F(Sacred, DashIsStdinAndStdout) {
  const Outcome plan = scratch.run("plan - -o - <task.yaml");
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_TRUE(nlohmann::json::accept(plan.out));
  EXPECT_NE(plan.err.find("CERTIFIED"), std::string::npos);
  scratch.write("q.json", plan.out);
  EXPECT_EQ(scratch.run("certify task.yaml - <q.json").status, 0);
  EXPECT_NE(scratch.run("plot task.yaml q.json -o -").out.find("</svg>"), std::string::npos);
  EXPECT_EQ(scratch.run("export task.yaml q.json -o -").out.find("robot,t,x"), 0u);
  const Outcome log = scratch.run("simulate task.yaml q.json --log -");
  EXPECT_EQ(log.status, 0);
  EXPECT_EQ(log.out.find("t,plan_time"), 0u);
  EXPECT_EQ(log.out.find("ARRIVED"), std::string::npos);
  EXPECT_NE(log.err.find("ARRIVED"), std::string::npos);
  EXPECT_EQ(scratch.run("bench task.yaml -o -").out.find("# seine "), 0u);
  EXPECT_EQ(scratch.run("generate swap --robots 3 -o -").out.find("seine: 1"), 0u);
  EXPECT_FALSE(scratch.has("-"));
  EXPECT_EQ(scratch.run("plan task.yaml --json -o -").status, 2);
}

TEST_F(Sacred, SeveralWritersOfOneResultFileLoseNothing) {
  constexpr int kWriters = 4, kSeeds = 6;
  std::string all;
  for (int k = 0; k < kWriters; ++k) {
    all += "'" SEINE_PROGRAM "' bench --family " + std::string(k % 2 == 0 ? "swap" : "random") +
           " --robots " + std::to_string(2 + k / 2) + " --seeds " + std::to_string(kSeeds) +
           " --threads 1 -o r.csv >/dev/null || echo failed >&2 &\n";
  }
  scratch.write("run.sh", all + "wait\n");
  const Outcome outcome = scratch.run("--version && bash run.sh");
  EXPECT_EQ(outcome.err, "");
  std::istringstream lines(scratch.read("r.csv"));
  std::set<std::string> instances;
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#' || line.starts_with("group,")) continue;
    ++rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 20) << line;
    instances.insert(line.substr(0, line.find(',', line.find(',') + 1)));
  }
  EXPECT_EQ(rows, kWriters * kSeeds);
  EXPECT_EQ(static_cast<int>(instances.size()), kWriters * kSeeds);
}

TEST_F(Sacred, AResultFileGoesOnAfterACutLineAndIsNoTask) {
  fs::create_directory(scratch.folder() / "tasks");
  scratch.write("tasks/a.yaml", two_cars());
  ASSERT_EQ(scratch.run("bench tasks -o tasks/r.csv").status, 0);
  const std::string whole = scratch.read("tasks/r.csv");
  scratch.write("tasks/r.csv", whole + "tasks,b.yaml,certi");
  ASSERT_EQ(scratch.run("bench tasks -o tasks/r.csv").status, 0);
  EXPECT_EQ(scratch.read("tasks/r.csv"), whole);
  scratch.write("letter.txt", "Dear reader,\n");
  EXPECT_EQ(scratch.run("bench tasks -o letter.txt").status, 2);
  EXPECT_EQ(scratch.read("letter.txt"), "Dear reader,\n");
}

TEST_F(Sacred, NamesThatAreNoUtf8AreRefusedAtReading) {
  for (const std::string name : {"c\xff", "\xc0\xaf", "\xed\xa0\x80", "x\xe2\x82"}) {
    std::string text = two_cars();
    text.replace(text.find("left"), 4, name);
    scratch.write("bad.yaml", text);
    const Outcome outcome = scratch.run("plan bad.yaml -o q.json");
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_TRUE(is_one_line(outcome.err)) << outcome.err;
    EXPECT_EQ(outcome.err.find("bad.yaml:"), std::string("seine: ").size()) << outcome.err;
  }
  EXPECT_EQ(scratch.run("plan \"$(printf 'n\\377.yaml')\"").status, 2);  // no such file
  fs::copy_file(scratch.folder() / "task.yaml", scratch.folder() / "n\xff.yaml");
  ASSERT_EQ(scratch.run("plan \"$(printf 'n\\377.yaml')\" -o q.json").status, 0);
  EXPECT_TRUE(nlohmann::json::accept(scratch.read("q.json")));
}

}  // namespace
}  // namespace seine::tests
