#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "seine/base/effort.hpp"
#include "seine/base/error.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/reading.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/utf8.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "seine-write-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path operator/(const char* name) const { return path_ / name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

// Readers see the old text or the new one, whole, and killed writers leave nothing behind.
TEST(WriteFile, IsAllOrNothing) {
  const Folder folder;
  const fs::path file = folder / "f.txt";
  const std::string first(200000, 'a'), second(300000, 'b');
  write_file(file, first);
  std::vector<std::jthread> writers;
  for (int k = 0; k < 3; ++k)
    writers.emplace_back([&, k] {
      for (int i = 0; i < effort(40, 10); ++i) write_file(file, (i + k) % 2 == 0 ? first : second);
    });
  for (int i = 0; i < effort(200, 40); ++i) {
    const std::string seen = read_file(file, 1 << 20);
    ASSERT_TRUE(seen == first || seen == second) << seen.size();
  }
  for (std::jthread& writer : writers) writer.join();
  EXPECT_EQ(folder.entries(), 1u);
  for (int i = 0; i < effort(30, 5); ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) write_file(file, second);
    }
    ::usleep(static_cast<useconds_t>(300 * (i + 1)));
    ::kill(child, SIGTERM);
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(folder.entries(), 1u);
    const std::string seen = read_file(file, 1 << 20);
    ASSERT_TRUE(seen == first || seen == second) << seen.size();
  }
}

TEST(WriteFile, FailuresThrowAndChangeNothing) {
  const Folder folder;
  EXPECT_THROW(write_file("/dev/full", "text"), InputError);
  EXPECT_THROW(write_file(folder / "no/such.txt", "text"), InputError);
  EXPECT_THROW(write_file(folder / ".", "text"), InputError);
  EXPECT_NO_THROW(write_file("/dev/null", "text"));
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Reading, KnowsFilesByAnyName) {
  const Folder folder;
  write_file(folder / "a.txt", "a");
  write_file(folder / "b.txt", "b");
  fs::create_hard_link(folder / "a.txt", folder / "hard.txt");
  fs::create_symlink(folder / "a.txt", folder / "soft.txt");
  Reading reading;
  reading.add_file(folder / "a.txt");
  reading.add_file("/dev/null");
  for (const char* name : {"a.txt", "hard.txt", "soft.txt", "./a.txt"})
    EXPECT_THROW(expect_not_read(folder / name, reading), InputError) << name;
  for (const char* name : {"b.txt", "new.txt"}) EXPECT_NO_THROW(expect_not_read(folder / name, reading));
  EXPECT_NO_THROW(expect_not_read("/dev/null", reading));
}

TEST(Utf8, IsToldFromOtherBytes) {
  for (const char* good :
       {"", "plain", "\u00e9", "\u20ac", "\U0001f697", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(good)) << good;
    EXPECT_EQ(as_utf8(good), good);
  }
  for (const char* bad : {"\x80", "\xff", "\xc0\xaf", "\xc3", "\xe0\x80\x80", "\xed\xa0\x80", "\xe2\x82",
                          "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "a\xe9z"}) {
    EXPECT_FALSE(is_utf8(bad));
    EXPECT_TRUE(is_utf8(as_utf8(bad)));
  }
}

std::string task(const std::string& heading) {
  return "seine: 1\nworld: {bounds: [-5, -5, 5, 5]}\nrobots:\n  - {name: ann, start: {x: 0, y: 0, heading: " +
         heading + "}, goal: {x: 3, y: 0, heading: 0}}\n";
}

TEST(Angles, AreRadiansOrDegreesThatSaySo) {
  for (const char* text : {"90 deg", "90deg", "90.0 degrees", "90\u00b0", "1.5707963267948966", "450 deg"}) {
    Reading reading;
    const world::Scenario scenario = parse_scenario(task(text), "t.yaml", ".", {}, &reading);
    EXPECT_NEAR(scenario.robots[0].start.heading, 1.5707963267948966, 1e-12) << text;
    EXPECT_TRUE(reading.notes.empty()) << text;
  }
  Reading reading;
  parse_scenario(task("90"), "t.yaml", ".", {}, &reading);
  ASSERT_EQ(reading.notes.size(), 1u);
  EXPECT_NE(reading.notes[0].find("t.yaml:4: "), std::string::npos) << reading.notes[0];
  EXPECT_NE(reading.notes[0].find("'90 deg'"), std::string::npos) << reading.notes[0];
  ASSERT_EQ(reading.robots.size(), 1u);
  EXPECT_EQ(reading.robots[0].goal, "t.yaml:4");
  for (const char* text : {"north", "90 gon", "deg", "nan deg", "1e9 deg", ".inf"})
    EXPECT_THROW(parse_scenario(task(text), "t.yaml", "."), InputError) << text;
}

}  // namespace
}  // namespace seine::io
