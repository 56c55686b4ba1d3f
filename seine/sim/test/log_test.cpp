// What is written must be readable by somebody who knows only the formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "seine/sim/csv_log.hpp"
#include "seine/sim/json_text.hpp"
#include "seine/sim/mcap_log.hpp"
#include "seine/sim/test/drives.hpp"

namespace seine::sim {
namespace {

template <class Log>
std::string log_of(const Drive& drive) {
  std::ostringstream out;
  Log log(out);
  simulate(drive.scenario, drive.plan, plain_tracker(drive.scenario), {.recorder = &log});
  return out.str();
}

Drive short_drive() {
  Drive drive = drive_of(3, 1.0, 1.5, 0.1);
  drive.scenario.targets = {throw_at(drive, 0.9, {0.5, 0.0, -4.0})};
  drive.scenario.robots[1].name = "a \"quoted\", name";
  return drive;
}

// Cells of a line, quotes undone.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

TEST(CsvLog, IsATable) {
  const Drive drive = short_drive();
  std::istringstream text(log_of<CsvLog>(drive));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = cells_of(line);
  EXPECT_EQ(names[0], "t");
  EXPECT_EQ(names.back(), "note");
  EXPECT_NE(std::find(names.begin(), names.end(), "a \"quoted\", name.reference_x"), names.end());
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  double time = -1.0;
  std::string notes;
  int rows = 0;
  while (std::getline(text, line)) {
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_EQ(cells.size(), names.size()) << "row " << rows;
    EXPECT_GT(std::stod(cells[0]), time);
    time = std::stod(cells[0]);
    const traj::State reference = drive.plan.robots[2].at(std::stod(cells[column("plan_time")]));
    EXPECT_NEAR(std::stod(cells[column("car2.reference_x")]), reference.pose.x, 1e-5);
    notes += cells.back();
    ++rows;
  }
  EXPECT_NEAR(time, 0.01 * (rows - 1), 1e-9);
  EXPECT_NE(notes.find("lies in the net"), std::string::npos);
}

// A reader of MCAP, as far as it takes to check one.
struct McapRecord {
  int opcode;
  std::string content;
};

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

McapRecord record_at(const std::string& bytes, std::size_t& at) {
  const int opcode = static_cast<unsigned char>(bytes.at(at));
  const std::size_t length = number_at(bytes, at + 1, 8);
  EXPECT_LE(at + 9 + length, bytes.size());
  McapRecord record{opcode, bytes.substr(at + 9, length)};
  at += 9 + length;
  return record;
}

const std::string kMagic("\x89MCAP0\r\n");

TEST(McapLog, CanBeReadFromEitherEnd) {
  const std::string bytes = log_of<McapLog>(short_drive());
  ASSERT_EQ(bytes.substr(0, 8), kMagic);
  ASSERT_EQ(bytes.substr(bytes.size() - 8), kMagic);
  std::size_t at = 8, messages = 0, indexed = 0;
  std::string chunk;
  std::map<std::uint64_t, std::size_t> offsets;  // where chunks begin
  std::uint64_t last = 0, told = 0;
  while (at + 8 < bytes.size()) {
    const std::size_t start = at;
    const McapRecord record = record_at(bytes, at);
    if (record.opcode == 0x06) {
      const std::size_t header = 8 + 8 + 8 + 4 + 4;
      chunk = record.content.substr(header + 8);
      EXPECT_EQ(number_at(record.content, header, 8), chunk.size());
      offsets[start] = at - start;
      for (std::size_t inner = 0; inner < chunk.size();) {
        const McapRecord message = record_at(chunk, inner);
        if (message.opcode != 0x05) continue;
        ++messages;
        EXPECT_GE(number_at(message.content, 6, 8), last);
        last = number_at(message.content, 6, 8);
        EXPECT_EQ(message.content[22], '{');
        EXPECT_EQ(message.content.back(), '}');
      }
    } else if (record.opcode == 0x07) {
      const std::size_t length = number_at(record.content, 2, 4);
      for (std::size_t entry = 6; entry < 6 + length; entry += 16) {
        std::size_t place = number_at(record.content, entry + 8, 8);
        const McapRecord message = record_at(chunk, place);
        EXPECT_EQ(message.opcode, 0x05);
        EXPECT_EQ(message.content.substr(0, 2), record.content.substr(0, 2)) << "the channel";
        EXPECT_EQ(number_at(message.content, 6, 8), number_at(record.content, entry, 8)) << "the time";
        ++indexed;
      }
    } else if (record.opcode == 0x08) {
      EXPECT_EQ(offsets.at(number_at(record.content, 16, 8)), number_at(record.content, 24, 8));
    } else if (record.opcode == 0x0B) {
      told = number_at(record.content, 0, 8);
    } else if (record.opcode == 0x02) {
      std::size_t summary = number_at(record.content, 0, 8);
      EXPECT_EQ(record_at(bytes, summary).opcode, 0x03);
    }
  }
  EXPECT_GT(messages, 1000u);
  EXPECT_EQ(messages, indexed);
  EXPECT_EQ(messages, told);
}

TEST(JsonText, EscapesWhatItMust) {
  JsonText json;
  json.open('{')
      .field("a\"b", "c\\d\n")
      .field("x", 0.1 + 0.2)
      .key("y")
      .open('[')
      .number(1e300 * 1e10)
      .number(-0.0);
  json.close(']').close('}');
  EXPECT_EQ(json.str(), "{\"a\\\"b\":\"c\\\\d\\u000a\",\"x\":0.3,\"y\":[null,0]}");
}

}  // namespace
}  // namespace seine::sim
