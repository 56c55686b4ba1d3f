#include "apps/seine/bench_rows.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "apps/seine/output.hpp"
#include "seine/base/error.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"

namespace seine::app {
namespace {

struct TextColumn {
  std::string_view name;
  std::string Row::*value;
};
struct NumberColumn {
  std::string_view name;
  double Row::*value;
};

constexpr std::array kTexts{TextColumn{"group", &Row::group}, TextColumn{"instance", &Row::instance},
                            TextColumn{"status", &Row::status}, TextColumn{"reason", &Row::reason}};
constexpr std::array kNumbers{NumberColumn{"robots", &Row::robots},
                              NumberColumn{"compute_s", &Row::compute},
                              NumberColumn{"guess_s", &Row::guess},
                              NumberColumn{"corridor_s", &Row::corridor},
                              NumberColumn{"optimise_s", &Row::optimise},
                              NumberColumn{"certify_s", &Row::certify},
                              NumberColumn{"iterations", &Row::iterations},
                              NumberColumn{"repairs", &Row::repairs},
                              NumberColumn{"makespan_s", &Row::makespan},
                              NumberColumn{"mean_travel_s", &Row::mean_travel},
                              NumberColumn{"distance_m", &Row::distance},
                              NumberColumn{"acceleration_cost", &Row::acceleration_cost},
                              NumberColumn{"gear_changes", &Row::gear_changes},
                              NumberColumn{"best_makespan_s", &Row::best_makespan},
                              NumberColumn{"min_robot_clearance_m", &Row::robot_clearance},
                              NumberColumn{"min_obstacle_clearance_m", &Row::obstacle_clearance},
                              NumberColumn{"alone_travel_s", &Row::alone}};

std::string header() {
  std::string line;
  for (const TextColumn& column : kTexts) line += std::string(column.name) + ",";
  for (const NumberColumn& column : kNumbers) line += std::string(column.name) + ",";
  line.pop_back();
  return line;
}

/// A field without what would break the line: commas and quotes have no business in names and reasons.
std::string field(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ';';
    if (c == '\n' || c == '"') c = ' ';
  }
  return text;
}

std::string line_of(const Row& row) {
  std::string line;
  for (const TextColumn& column : kTexts) line += field(row.*column.value) + ",";
  for (const NumberColumn& column : kNumbers) {
    const double value = row.*column.value;
    line += (std::isfinite(value) ? io::rounded_text(value, 6) : "") + ",";
  }
  line.pop_back();
  return line;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line + ",");
  for (std::string text; std::getline(in, text, ',');) fields.push_back(text);
  return fields;
}

/// `names` says which column each field belongs to.
Row parse_row(const std::vector<std::string>& names, const std::string& line) {
  const std::vector<std::string> fields = fields_of(line);
  std::map<std::string_view, std::string_view> by_name;
  for (std::size_t i = 0; i < names.size() && i < fields.size(); ++i) by_name[names[i]] = fields[i];
  Row row;
  for (const TextColumn& column : kTexts) row.*column.value = by_name[column.name];
  for (const NumberColumn& column : kNumbers) {
    row.*column.value = io::parse_number(by_name[column.name]).value_or(Row::kNone);
  }
  return row;
}

}  // namespace

/// Nobody else writes to the file while it lives. File systems without locks have one writer.
class RowFile::Lock {
 public:
  explicit Lock(int file) : file_(file) {
    while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Lock() { ::flock(file_, LOCK_UN); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

RowFile::RowFile(const std::string& path, const std::string& settings) : path_(path), settings_(settings) {
  if (path.empty()) return;
  if (is_stdout(path)) {
    file_ = ::dup(STDOUT_FILENO);
  } else {
    struct stat found {};
    regular_ = ::stat(path.c_str(), &found) != 0 || S_ISREG(found.st_mode);
    file_ = ::open(path.c_str(), (regular_ ? O_RDWR | O_CREAT | O_APPEND : O_WRONLY) | O_CLOEXEC, 0666);
  }
  if (file_ < 0) throw InputError(path + ": cannot be written: " + std::strerror(errno));
  try {
    begin();
  } catch (...) {
    ::close(file_);
    throw;
  }
}

RowFile::~RowFile() {
  if (file_ >= 0) ::close(file_);
}

void RowFile::begin() {
  const std::string head = "# " + settings_ + "\n" + header() + "\n";
  if (!regular_) return write(head);
  const Lock lock(file_);
  std::string start(head.size(), '\0');
  const ssize_t size = ::pread(file_, start.data(), start.size(), 0);
  if (size == 0) return write(head);
  std::istringstream lines(start.substr(0, size > 0 ? static_cast<std::size_t>(size) : 0));
  std::string first, names;
  std::getline(lines, first);
  std::getline(lines, names);
  if (!first.starts_with("# seine ")) {
    throw io::complaint(path_, 1,
                        "is no result file of this version: remove it or give another name with -o");
  }
  if (first != "# " + settings_) {
    throw io::complaint(path_, 1,
                        "was made with '" + first.substr(2) + "', not '" + settings_ +
                            "': remove it or give another name with -o");
  }
  if (names != header()) {
    throw io::complaint(path_, 2,
                        "is no result file of this version: remove it or give another name with -o");
  }
  read_ = static_cast<std::int64_t>(head.size());
  take_in();
}

void RowFile::refresh() {
  if (!regular_) return;
  const Lock lock(file_);
  take_in();
}

// Under the lock a line without an end is one that was cut off by an interrupt: nobody is at it now.
void RowFile::take_in() {
  std::string text;
  char chunk[1 << 16];
  for (ssize_t size;
       (size = ::pread(file_, chunk, sizeof chunk, read_ + static_cast<off_t>(text.size()))) > 0;)
    text.append(chunk, static_cast<std::size_t>(size));
  const std::size_t whole = text.rfind('\n') + 1;  // 0 where there is none
  if (whole < text.size() && ::ftruncate(file_, read_ + static_cast<off_t>(whole)) != 0)
    throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
  read_ += static_cast<std::int64_t>(whole);
  std::istringstream lines(text.substr(0, whole));
  const std::vector<std::string> names = fields_of(header());
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    Row row = parse_row(names, line);
    if (known_.insert({row.group, row.instance}).second) rows_.push_back(std::move(row));
  }
}

// All of it or nothing.
void RowFile::write(const std::string& text) {
  if (!io::write_all(file_, text)) {
    const int error = errno;
    if (regular_) static_cast<void>(!::ftruncate(file_, read_));
    throw InputError((is_stdout(path_) ? "stdout" : path_) + ": cannot be written: " + std::strerror(error));
  }
  read_ += static_cast<std::int64_t>(text.size());
}

void RowFile::append(const Row& row) {
  const std::string line = line_of(row) + "\n";
  std::optional<Lock> lock;
  if (regular_) {
    lock.emplace(file_);
    take_in();
  }
  if (!known_.insert({row.group, row.instance}).second) return;
  rows_.push_back(row);
  if (file_ >= 0) write(line);
}

std::vector<Row> read_reference(const std::string& path) {
  if (path.empty()) return {};
  std::ifstream in(path);
  std::string names;
  if (!std::getline(in, names)) throw InputError(path + ": cannot be read");
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) rows.push_back(parse_row(fields_of(names), line));
  return rows;
}

}  // namespace seine::app
