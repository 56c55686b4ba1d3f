#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "seine/sim/mcap_writer.hpp"
#include "seine/sim/recorder.hpp"

namespace seine::sim {

/// Every signal as an MCAP file that Foxglove and its relatives open: the scene in 3-D, a frame and a state
/// for each car, a state for each target, and notes.
class McapLog final : public Recorder {
 public:
  /// @param out must outlive this
  explicit McapLog(std::ostream& out) : writer_(out) {}

  void begin(const world::Scenario& scenario) override;
  void record(const Record& record) override;
  void note(const Note& note) override;
  void end() override { writer_.close(); }

 private:
  void draw(const Record& record, std::uint64_t time);
  void add_targets(std::size_t count);

  McapWriter writer_;
  const world::Scenario* scenario_ = nullptr;
  std::uint16_t scene_ = 0, frames_ = 0, notes_ = 0, target_schema_ = 0;
  std::vector<std::uint16_t> cars_, targets_;
  std::vector<std::string> names_;
  std::uint64_t last_ = 0;  // ns: times never go back
  int records_ = 0;
};

}  // namespace seine::sim
