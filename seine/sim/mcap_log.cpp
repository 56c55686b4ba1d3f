#include "seine/sim/mcap_log.hpp"

#include <algorithm>
#include <cmath>

#include "seine/sim/foxglove.hpp"

namespace seine::sim {
namespace {

constexpr int kDrawEvery = 4;  // records: 25 pictures a second

std::uint64_t nanoseconds(double time) {
  return static_cast<std::uint64_t>(std::llround(1e9 * std::max(0.0, time)));
}

}  // namespace

void McapLog::begin(const world::Scenario& scenario) {
  scenario_ = &scenario;
  const std::uint16_t scene = writer_.add_schema("foxglove.SceneUpdate", foxglove::scene_update_schema());
  const std::uint16_t frame =
      writer_.add_schema("foxglove.FrameTransform", foxglove::frame_transform_schema());
  const std::uint16_t log = writer_.add_schema("foxglove.Log", foxglove::log_schema());
  const std::uint16_t car = writer_.add_schema("seine.Car", foxglove::car_schema());
  target_schema_ = writer_.add_schema("seine.Target", foxglove::target_schema());
  scene_ = writer_.add_channel("/scene", scene);
  frames_ = writer_.add_channel("/tf", frame);
  notes_ = writer_.add_channel("/notes", log);
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const std::string& name = scenario.robots[k].name;
    names_.push_back(name.empty() ? "robot" + std::to_string(k + 1) : name);
    cars_.push_back(writer_.add_channel("/" + names_.back(), car));
  }
  writer_.write(scene_, 0, foxglove::surroundings(scenario));
}

void McapLog::add_targets(std::size_t count) {
  while (targets_.size() < count)
    targets_.push_back(writer_.add_channel("/target" + std::to_string(targets_.size() + 1), target_schema_));
}

void McapLog::record(const Record& record) {
  last_ = std::max(last_, nanoseconds(record.time));
  add_targets(record.targets.size());
  for (std::size_t k = 0; k < record.cars.size(); ++k)
    writer_.write(cars_[k], last_, foxglove::car(record.cars[k], record.time));
  for (std::size_t i = 0; i < record.targets.size(); ++i)
    if (record.targets[i].present)
      writer_.write(targets_[i], last_, foxglove::target(record.targets[i], record.time));
  if (records_++ % kDrawEvery == 0) draw(record, last_);
}

void McapLog::draw(const Record& record, std::uint64_t time) {
  writer_.write(scene_, time, foxglove::scene_update(*scenario_, record));
  for (std::size_t k = 0; k < record.cars.size(); ++k)
    writer_.write(frames_, time,
                  foxglove::frame_transform(names_[k], record.cars[k].truth.pose, record.time));
}

void McapLog::note(const Note& note) {
  last_ = std::max(last_, nanoseconds(note.time));
  writer_.write(notes_, last_, foxglove::log(note));
}

}  // namespace seine::sim
