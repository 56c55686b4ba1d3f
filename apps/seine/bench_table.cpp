#include "apps/seine/bench_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace seine::app {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return Row::kNone;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return Row::kNone;
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) {
  return values.empty() ? Row::kNone : *std::max_element(values.begin(), values.end());
}

/// The numbers of one column, where they are.
std::vector<double> column(const std::vector<const Row*>& rows, double Row::*value) {
  std::vector<double> values;
  for (const Row* row : rows) {
    if (std::isfinite(row->*value)) values.push_back(row->*value);
  }
  return values;
}

/// `value` right-aligned in `width`, blank where there is none.
std::string cell(double value, int width, int digits) {
  char text[64];
  if (std::isfinite(value)) {
    std::snprintf(text, sizeof text, "%*.*f", width, digits, value);
  } else {
    std::snprintf(text, sizeof text, "%*s", width, "");
  }
  return text;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

constexpr int kFailuresShown = 3;  // of a group; the file has them all
constexpr const char* kHead =
    "                          certified      compute s       guess   optim.  certify   travel s        "
    "dist. m  accel.  "
    "over\n"
    "                                         median    max   s, medians                mean  longest        "
    "  cost    "
    "alone\n";

std::string line_of(const std::string& name, const std::string& certified,
                    const std::vector<const Row*>& rows) {
  std::vector<const Row*> compared;  // the ratio is of means over the same instances
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(compared),
               [](const Row* row) { return std::isfinite(row->alone); });
  const double ratio = mean(column(compared, &Row::mean_travel)) / mean(column(compared, &Row::alone));
  return padded(name, 26) + padded(certified, 13) + cell(median(column(rows, &Row::compute)), 8, 3) +
         cell(rows.size() > 1 ? largest(column(rows, &Row::compute)) : Row::kNone, 8, 3) +
         cell(median(column(rows, &Row::guess)), 8, 3) + cell(median(column(rows, &Row::optimise)), 9, 3) +
         cell(median(column(rows, &Row::certify)), 9, 3) + cell(mean(column(rows, &Row::mean_travel)), 8, 2) +
         cell(mean(column(rows, &Row::makespan)), 8, 2) + cell(mean(column(rows, &Row::distance)), 10, 1) +
         cell(mean(column(rows, &Row::acceleration_cost)), 8, 1) + cell(ratio, 7, 3) + "\n";
}

}  // namespace

std::string table(const std::vector<Row>& rows, const std::vector<Row>& reference) {
  std::vector<std::string> groups;  // in the order of their first row
  for (const Row& row : rows) {
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
  }
  std::string text = kHead;
  for (const std::string& group : groups) {
    std::vector<const Row*> certified, refused;
    std::size_t asked = 0;
    for (const Row& row : rows) {
      if (row.group != group) continue;
      if (row.status == "refused") {
        refused.push_back(&row);
        continue;
      }
      ++asked;
      if (row.status == "certified") certified.push_back(&row);
    }
    text += line_of(group, std::to_string(certified.size()) + " of " + std::to_string(asked), certified);
    if (!refused.empty()) {
      text += padded("", 26) + "and " + std::to_string(refused.size()) +
              " refused as wrong in themselves, in at most " +
              cell(1e3 * largest(column(refused, &Row::compute)), 1, 1) + " ms\n";
    }
    int shown = 0;
    for (const Row& row : rows) {
      if (row.group == group && (row.status == "no" || row.status == "impossible") &&
          shown++ < kFailuresShown) {
        text += "    no plan for " + row.instance + ": " + row.reason + "\n";
      }
    }
    for (const Row& row : reference) {
      if (row.group == group) text += line_of("  " + row.instance, row.status, {&row});
    }
  }
  return text;
}

}  // namespace seine::app
