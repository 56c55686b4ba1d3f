#pragma once

#include <fstream>
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

/// Rows in a CSV file that grows line by line, so that an interrupted run goes on where it stopped.
class RowFile {
 public:
  /// Reads the rows `path` already has. Throws InputError when the file was made with other `settings` or is
  /// no such file.
  /// @param path empty: rows are kept in memory only
  RowFile(const std::string& path, const std::string& settings);

  bool has(const std::string& group, const std::string& instance) const {
    return known_.contains({group, instance});
  }
  void append(const Row& row);
  const std::vector<Row>& rows() const { return rows_; }

 private:
  void read(const std::string& path, const std::string& settings);

  std::vector<Row> rows_;
  std::set<std::pair<std::string, std::string>> known_;
  std::ofstream out_;
};

/// Published numbers to stand beside a group: the columns of a CSV with the same names, others missing.
std::vector<Row> read_reference(const std::string& path);

}  // namespace seine::app
