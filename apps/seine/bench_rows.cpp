#include "apps/seine/bench_rows.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>

#include "seine/base/error.hpp"
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

RowFile::RowFile(const std::string& path, const std::string& settings) {
  if (path.empty()) return;
  if (std::filesystem::exists(path)) read(path, settings);
  out_.open(path);  // written anew: the last line may have been cut off by an interrupt
  if (!out_) throw InputError(path + ": cannot be written");
  out_ << "# " << settings << "\n" << header() << "\n";
  for (const Row& row : rows_) out_ << line_of(row) << "\n";
  out_.flush();
}

void RowFile::read(const std::string& path, const std::string& settings) {
  std::ifstream in(path);
  std::string first, names;
  if (!std::getline(in, first) || !std::getline(in, names) || names != header()) {
    throw io::complaint(path, 1, "is no result file of this version: remove it or give another name with -o");
  }
  if (first != "# " + settings) {
    throw io::complaint(path, 1,
                        "was made with '" + first.substr(std::min<std::size_t>(2, first.size())) +
                            "', not '" + settings + "': remove it or give another name with -o");
  }
  for (std::string line; std::getline(in, line) && !in.eof();) {
    rows_.push_back(parse_row(fields_of(names), line));
    known_.insert({rows_.back().group, rows_.back().instance});
  }
}

void RowFile::append(const Row& row) {
  rows_.push_back(row);
  known_.insert({row.group, row.instance});
  if (out_.is_open())
    out_ << line_of(row) << std::endl;  // on disk at once: this is what a later run resumes from
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
