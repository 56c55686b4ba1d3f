#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "seine/optim/qp.hpp"

namespace seine::optim {

/// A problem of data/qp (format in its SOURCES.md) and its published optimum.
struct ReferenceQp {
  std::string name;
  QpProblem problem;
  double constant = 0.0;
  double optimum = 0.0;
};

inline double bound_of(const std::string& word) {
  return word == "inf" ? HUGE_VAL : word == "-inf" ? -HUGE_VAL : std::stod(word);
}

inline SparseMatrix read_triplets(std::istream& in, int rows, int cols) {
  int count = 0;
  in >> count;
  std::vector<Triplet> triplets(static_cast<std::size_t>(count));
  for (Triplet& t : triplets) in >> t.row >> t.col >> t.value;
  return from_triplets(rows, cols, triplets);
}

inline ReferenceQp read_qp(const std::filesystem::path& path) {
  std::ifstream in(path);
  ReferenceQp result{.name = path.stem().string(), .problem = {}};
  QpProblem& qp = result.problem;
  int n = 0, m = 0, count = 0;
  std::string word, low, high;
  while (in >> word) {
    if (word[0] == '#') std::getline(in, word);
    if (word == "n") in >> n;
    if (word == "m") in >> m;
    if (word == "r") in >> result.constant;
    if (word == "P") qp.P = read_triplets(in, n, n);
    if (word == "A") qp.A = read_triplets(in, m, n);
    if (word == "q") {
      in >> count;
      qp.q.resize(static_cast<std::size_t>(count));
      for (double& v : qp.q) in >> v;
    }
    if (word == "bounds") {
      in >> count;
      for (int i = 0; i < count && in >> low >> high; ++i)
        qp.lower.push_back(bound_of(low)), qp.upper.push_back(bound_of(high));
    }
  }
  return result;
}

/// All problems of a folder for which there is a file, in the order of their names.
inline std::vector<ReferenceQp> read_all(const std::string& folder, std::size_t column_of_optimum) {
  const std::filesystem::path path = std::filesystem::path(SEINE_DATA_DIR) / "qp" / folder;
  std::ifstream in(path / "reference.csv");
  std::string line, cell;
  std::map<std::string, double> optima;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::stringstream cells(line);
    std::vector<std::string> row;
    while (std::getline(cells, cell, ',')) row.push_back(cell);
    optima[row[0]] = std::stod(row[column_of_optimum]);
  }
  std::vector<ReferenceQp> all;
  for (const auto& [name, optimum] : optima) {
    if (!std::filesystem::exists(path / (name + ".qp"))) continue;
    all.push_back(read_qp(path / (name + ".qp")));
    all.back().optimum = optimum;
  }
  return all;
}
inline std::vector<ReferenceQp> maros_meszaros() {
  return read_all("maros_meszaros", 5);
}
inline std::vector<ReferenceQp> walking_and_balancing() {
  return read_all("mpc_qpbenchmark", 3);
}

}  // namespace seine::optim
