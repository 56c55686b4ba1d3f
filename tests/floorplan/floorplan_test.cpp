#include "tests/floorplan/floorplan.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace seine::tests {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST(FloorPlan, TheHouseStands) {
  EXPECT_EQ(joined(offences(SEINE_SOURCE_DIR)), "");
}

TEST(FloorPlan, TheDrawingShowsThePlan) {
  std::vector<std::string> none;
  const FloorPlan plan = read_floor_plan(SEINE_SOURCE_DIR, none);
  std::ifstream in(fs::path(SEINE_SOURCE_DIR) / "docs" / "architecture.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [room, uses] : plan.uses) {
    const std::size_t row = page.find("| `" + room + "` | ");
    ASSERT_NE(row, std::string::npos) << room << " has no row in docs/architecture.md: ./dev floorplan";
    const std::size_t from = page.find('|', row + 1) + 1;
    std::string cell = page.substr(from, page.find('|', from) - from);
    std::replace(cell.begin(), cell.end(), ',', ' ');
    std::istringstream words(cell);
    std::set<std::string> shown;
    for (std::string word; words >> word;) shown.insert(word);
    EXPECT_EQ(shown, uses) << room << ": ./dev floorplan";
    EXPECT_EQ(page.find(" --> " + room + "\n") == std::string::npos, uses.empty())
        << room << ": ./dev floorplan";
  }
}

/// A small house in a temporary folder, sound as built.
class PlantedOffence : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("seine-floorplan-" + std::to_string(::getpid()) + "-" +
                                         testing::UnitTest::GetInstance()->current_test_info()->name());
    write("tools/floorplan.txt", "# plan\nbase:\nmath: base\ngeom: base\nio: base geom\n");
    write("seine/base/error.hpp", "#pragma once\n#include <string>\n");
    write("seine/math/root.hpp", "#include \"seine/base/error.hpp\"\n");
    write("seine/geom/shape.hpp", "#include \"seine/base/error.hpp\"\n#include \"seine/geom/point.hpp\"\n");
    write("seine/geom/point.hpp", "\n");
    write("seine/geom/test/shape_test.cpp", "#include \"seine/geom/shape.hpp\"\n#include <gtest/gtest.h>\n");
    write("seine/io/read.cpp", "#include <yaml-cpp/yaml.h>\n#include \"seine/geom/shape.hpp\"\n");
    write("apps/tool/main.cpp", "#include <CLI/CLI.hpp>\n#include \"seine/io/read.cpp\"\n");
    ASSERT_EQ(joined(offences(root_)), "");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  /// The one complaint about the tree must contain `text`.
  void expect_offence(const std::string& text) const {
    const std::vector<std::string> found = offences(root_);
    ASSERT_EQ(found.size(), 1U) << joined(found);
    EXPECT_NE(found[0].find(text), std::string::npos) << found[0];
  }

  fs::path root_;
};

TEST_F(PlantedOffence, ARoomThatIsNotOnTheLine) {
  write("seine/geom/sibling.hpp", "\n#include \"seine/math/root.hpp\"\n");
  expect_offence("seine/geom/sibling.hpp:2: room geom may not include room math");
}

TEST_F(PlantedOffence, ALaterRoom) {
  write("seine/base/upward.hpp", "#  include \"seine/geom/shape.hpp\"\n");
  expect_offence("room base may not include room geom");
}

TEST_F(PlantedOffence, ALaterRoomInATest) {
  write("seine/base/test/upward_test.cpp", "#include \"seine/geom/shape.hpp\"\n");
  expect_offence("room base may not include room geom");
}

TEST_F(PlantedOffence, ARelativeInclude) {
  write("seine/geom/near.cpp", "#include \"shape.hpp\"\n");
  expect_offence("is relative");
}

TEST_F(PlantedOffence, AnIncludeThroughTheParent) {
  write("seine/geom/near.cpp", "#include \"../geom/shape.hpp\"\n");
  expect_offence("is relative");
}

TEST_F(PlantedOffence, OwnHeadersInAngles) {
  write("seine/geom/angles.cpp", "#include <seine/geom/shape.hpp>\n");
  expect_offence("in quotes");
}

TEST_F(PlantedOffence, AFolderThatIsNotOnThePlan) {
  write("seine/attic/box.hpp", "\n");
  expect_offence("seine/attic:0: the folder is not on the floor plan");
}

TEST_F(PlantedOffence, AFolderInsideARoom) {
  write("seine/geom/detail/box.hpp", "\n");
  expect_offence("a room has no folders but test");
}

TEST_F(PlantedOffence, ARoomInAWing) {
  write("tools/floorplan.txt",
        "base:\nmath: base\ngeom: base\nio: base geom\nwing/east: base\nwing/west: base\n");
  write("seine/wing/west/door.hpp", "#include \"seine/base/error.hpp\"\n");
  write("seine/wing/east/door.hpp",
        "#include \"seine/base/error.hpp\"\n#include \"seine/wing/east/door.hpp\"\n");
  ASSERT_EQ(joined(offences(root_)), "");
  write("seine/wing/east/sibling.hpp", "#include \"seine/wing/west/door.hpp\"\n");
  expect_offence("seine/wing/east/sibling.hpp:1: room wing/east may not include room wing/west");
  write("seine/wing/east/sibling.hpp", "\n");
  write("seine/wing/north/door.hpp", "\n");
  expect_offence("seine/wing/north:0: the folder is not on the floor plan");
}

TEST_F(PlantedOffence, AnUmbrellaHeader) {
  write("seine/seine.hpp", "#include \"seine/geom/shape.hpp\"\n");
  expect_offence("a file outside every room");
}

TEST_F(PlantedOffence, ARoomThatIncludesTheRoof) {
  write("apps/tool/tool.hpp", "\n");
  write("seine/io/roof.cpp", "#include \"apps/tool/tool.hpp\"\n");
  expect_offence("is roof: nothing includes it");
}

TEST_F(PlantedOffence, ARoofThatIncludesAnother) {
  write("apps/tool/tool.hpp", "\n");
  write("bench/run.cpp", "#include \"apps/tool/tool.hpp\"\n");
  expect_offence("is roof: nothing includes it");
}

TEST_F(PlantedOffence, AnotherRoomsTestCode) {
  write("seine/geom/test/planted.hpp", "\n");
  write("seine/io/borrow.cpp", "#include \"seine/geom/test/planted.hpp\"\n");
  expect_offence("belongs to the tests of room geom");
}

TEST_F(PlantedOffence, OnlyTestsOfTheWholeHouseBorrowARoomsTestCode) {
  write("seine/geom/test/planted.hpp", "\n");
  write("tests/all.cpp", "#include \"seine/geom/test/planted.hpp\"\n");
  EXPECT_EQ(joined(offences(root_)), "");
  write("bench/run.cpp", "#include \"seine/geom/test/planted.hpp\"\n");
  expect_offence("belongs to the tests of room geom");
}

TEST_F(PlantedOffence, ASecretToldElsewhere) {
  write("seine/geom/file.cpp", "#include <yaml-cpp/yaml.h>\n");
  expect_offence("is the business of io only");
}

TEST_F(PlantedOffence, AHeaderThatDoesNotExist) {
  write("seine/geom/lost.cpp", "#include \"seine/geom/lost.hpp\"\n");
  expect_offence("does not exist");
}

TEST_F(PlantedOffence, APlanWithACycle) {
  write("tools/floorplan.txt", "base: geom\nmath: base\ngeom: base\nio: base geom\n");
  expect_offence("room base uses geom, which is on no earlier line");
}

}  // namespace
}  // namespace seine::tests
