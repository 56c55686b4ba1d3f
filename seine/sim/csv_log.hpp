#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "seine/sim/recorder.hpp"

namespace seine::sim {

/// Every signal as a table: a row for each instant, a column for each signal, the names in the first row.
/// What is not there (an object not yet thrown, no sight of it) leaves its cell empty.
class CsvLog final : public Recorder {
 public:
  /// @param out must outlive this
  explicit CsvLog(std::ostream& out) : out_(out) {}

  void begin(const world::Scenario& scenario) override;
  void record(const Record& record) override;
  void note(const Note& note) override;
  void end() override { out_.flush(); }

 private:
  void head(const Record& record);
  void cell(double value);
  void cell(const std::string& text);
  void empty(int count);
  void row(const CarRecord& car);
  void row(const TargetRecord& target);

  std::ostream& out_;
  std::vector<std::string> robots_;
  std::string line_, notes_;
  bool headed_ = false;
};

}  // namespace seine::sim
