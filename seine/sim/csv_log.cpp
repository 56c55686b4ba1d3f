#include "seine/sim/csv_log.hpp"

#include <array>

#include "seine/sim/car_signals.hpp"
#include "seine/sim/number_format.hpp"

namespace seine::sim {
namespace {

constexpr int kDigits = 6;  // micrometres

constexpr std::array kTargetColumns{"x",
                                    "y",
                                    "z",
                                    "vx",
                                    "vy",
                                    "vz",
                                    "fate",
                                    "touching",
                                    "seen_x",
                                    "seen_y",
                                    "seen_z",
                                    "estimate_time",
                                    "estimate_x",
                                    "estimate_y",
                                    "estimate_z",
                                    "estimate_vx",
                                    "estimate_vy",
                                    "estimate_vz",
                                    "estimate_drag"};

}  // namespace

void CsvLog::begin(const world::Scenario& scenario) {
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const std::string& name = scenario.robots[k].name;
    robots_.push_back(name.empty() ? "robot" + std::to_string(k + 1) : name);
  }
}

void CsvLog::cell(double value) {
  if (!line_.empty()) line_ += ',';
  append_rounded(line_, value, kDigits);
}

void CsvLog::cell(const std::string& text) {
  if (!line_.empty()) line_ += ',';
  if (text.find_first_of(",\"\n") == std::string::npos) {
    line_ += text;
    return;
  }
  line_ += '"';
  for (const char c : text) line_ += c == '"' ? std::string("\"\"") : std::string(1, c);
  line_ += '"';
}

void CsvLog::empty(int count) {
  line_.append(static_cast<std::size_t>(count), ',');
}

void CsvLog::head(const Record& record) {
  for (const char* name : {"t", "plan_time", "plan_rate"}) cell(std::string(name));
  for (const std::string& robot : robots_)
    for (const Signal& signal : signals_of(CarRecord{})) cell(robot + "." + signal.name);
  for (std::size_t i = 0; i < record.targets.size(); ++i)
    for (const char* column : kTargetColumns) cell("target" + std::to_string(i + 1) + "." + column);
  cell(std::string("note"));
  out_ << line_ << '\n';
}

void CsvLog::record(const Record& record) {
  line_.clear();
  if (!headed_) head(record);
  headed_ = true;
  line_.clear();
  for (const double value : {record.time, record.plan_time, record.plan_rate}) cell(value);
  for (const CarRecord& car : record.cars) row(car);
  for (const TargetRecord& target : record.targets) row(target);
  cell(notes_);
  notes_.clear();
  out_ << line_ << '\n';
}

void CsvLog::row(const CarRecord& car) {
  for (const Signal& signal : signals_of(car)) cell(signal.value);
}

void CsvLog::row(const TargetRecord& target) {
  if (!target.present) {
    empty(static_cast<int>(kTargetColumns.size()));
    return;
  }
  const geom::Vec3 p = target.ball.position, v = target.ball.velocity;
  for (const double value : {p.x, p.y, p.z, v.x, v.y, v.z}) cell(value);
  cell(std::string(name_of(target.fate)));
  cell(target.touching ? 1.0 : 0.0);
  if (target.seen) {
    for (const double value : {target.seen->x, target.seen->y, target.seen->z}) cell(value);
  } else {
    empty(3);
  }
  if (!target.estimate) {
    empty(8);
    return;
  }
  const net::Target& e = *target.estimate;
  for (const double value :
       {e.time, e.position.x, e.position.y, e.position.z, e.velocity.x, e.velocity.y, e.velocity.z, e.drag})
    cell(value);
}

void CsvLog::note(const Note& note) {
  if (!notes_.empty()) notes_ += "; ";
  notes_ += note.text;
}

}  // namespace seine::sim
