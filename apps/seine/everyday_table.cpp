#include "apps/seine/everyday_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace seine::app {
namespace {

std::string vehicle_of(const Row& row) {
  return row.instance.substr(0, row.instance.find(' '));
}

/// The share'th part of the values from below, e.g. 0.5 the median; NaN when there is none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return Row::kNone;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return std::isfinite(value) ? text : "-";
}

/// One line of a table from the rows that belong to it.
std::string line_of(const std::string& name, const std::vector<const Row*>& rows) {
  int certified = 0, impossible = 0;
  std::vector<double> compute, over_best, gear_changes;
  for (const Row* row : rows) {
    certified += row->status == "certified";
    impossible += row->status == "impossible";
    if (std::isfinite(row->compute)) compute.push_back(1e3 * row->compute);
    if (row->best_makespan > 0.0) over_best.push_back(row->makespan / row->best_makespan);
    if (std::isfinite(row->gear_changes)) gear_changes.push_back(row->gear_changes);
  }
  double changes = 0.0;
  for (const double value : gear_changes) changes += value / static_cast<double>(gear_changes.size());
  char text[256];
  std::snprintf(text, sizeof text, "%-16s %5d %8d %5zu %9s %9s %8s %8s %8s\n", name.c_str(), certified,
                impossible, rows.size(), number("%.1f", quantile(compute, 0.5)).c_str(),
                number("%.0f", quantile(compute, 1.0)).c_str(),
                number("%.3f", quantile(over_best, 0.5)).c_str(),
                number("%.2f", quantile(over_best, 1.0)).c_str(),
                gear_changes.empty() ? "-" : number("%.2f", changes).c_str());
  return text;
}

std::string lines_by(const std::vector<Row>& rows, const std::function<std::string(const Row&)>& key) {
  std::vector<std::string> keys;  // in the order of their first row
  for (const Row& row : rows)
    if (std::find(keys.begin(), keys.end(), key(row)) == keys.end()) keys.push_back(key(row));
  std::string text;
  for (const std::string& name : keys) {
    std::vector<const Row*> chosen;
    for (const Row& row : rows)
      if (key(row) == name) chosen.push_back(&row);
    text += line_of(name, chosen);
  }
  return text;
}

}  // namespace

std::string everyday_table(const std::vector<Row>& rows) {
  const std::string head =
      "              certified impossible of   compute ms         over the best     gear\n"
      "                                       median   slowest   median    worst  changes\n";
  std::string text = head + lines_by(rows, [](const Row& row) { return row.group; }) + "\n" +
                     lines_by(rows, vehicle_of) + "\n";
  std::vector<const Row*> all;
  for (const Row& row : rows) all.push_back(&row);
  text += line_of("all", all);
  for (const Row& row : rows)
    if (row.status != "certified" && row.status != "impossible")
      text += "  " + row.group + " " + row.instance + ": " + row.reason + "\n";
  return text;
}

}  // namespace seine::app
