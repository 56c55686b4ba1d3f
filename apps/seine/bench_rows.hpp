#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace seine::app {

/// One instance's result: a line of the CSV. Numbers that have no meaning are NaN, in the file empty.
struct Row {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string group;     ///< the line of the table it counts in
  std::string instance;  ///< unique within the group
  std::string status;    ///< certified, no, impossible (proved), refused (the task is wrong in itself)
  std::string reason;
  double robots = kNone;
  double compute = kNone, guess = kNone, corridor = kNone, optimise = kNone, certify = kNone;  ///< s
  double iterations = kNone, repairs = kNone;
  double makespan = kNone, mean_travel = kNone, distance = kNone, acceleration_cost = kNone;
  double gear_changes = kNone;
  double best_makespan = kNone;                                ///< s, shortest that is known
  double robot_clearance = kNone, obstacle_clearance = kNone;  ///< m
  double alone = kNone;  ///< s, mean travel when every car is planned alone
};

/// Rows in a CSV file that grows line by line, so that an interrupted run goes on where it stopped. Several
/// programs may add to one file: each takes the others' rows for its own, and none is lost.
class RowFile {
 public:
  /// Reads the rows `path` already has. Throws InputError when the file was made with other `settings` or is
  /// no such file.
  /// @param path empty: rows are kept in memory only; "-": they go to stdout
  RowFile(const std::string& path, const std::string& settings);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Takes in what other programs have added.
  void refresh();
  bool has(const std::string& group, const std::string& instance) const {
    return known_.contains({group, instance});
  }
  /// On disk when it returns: this is what a later run resumes from. Throws InputError where it cannot be
  /// written. A row that is there already, by another program, stays as it is.
  void append(const Row& row);
  const std::vector<Row>& rows() const { return rows_; }

 private:
  class Lock;
  void begin();
  void take_in();
  void write(const std::string& text);

  std::string path_, settings_;
  std::vector<Row> rows_;
  std::set<std::pair<std::string, std::string>> known_;
  int file_ = -1;
  bool regular_ = false;   // others may write to it, and what it has can be read
  std::int64_t read_ = 0;  // bytes of it that are known
};

/// Published numbers to stand beside a group: the columns of a CSV with the same names, others missing.
std::vector<Row> read_reference(const std::string& path);

}  // namespace seine::app
