#include "seine/optim/qp_sparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "seine/base/error.hpp"

namespace seine::optim {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

SparseMatrix from_triplets(int rows, int cols, std::span<const Triplet> triplets) {
  for (const Triplet& t : triplets)
    if (t.row < 0 || t.row >= rows || t.col < 0 || t.col >= cols)
      throw InputError("sparse matrix: entry (" + std::to_string(t.row) + ", " + std::to_string(t.col) +
                       ") lies outside " + std::to_string(rows) + " x " + std::to_string(cols));
  std::vector<Triplet> sorted(triplets.begin(), triplets.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const Triplet& a, const Triplet& b) {
    return a.col != b.col ? a.col < b.col : a.row < b.row;
  });
  SparseMatrix m{.rows = rows, .cols = cols, .begin = std::vector<int>(at(cols) + 1), .row = {}, .value = {}};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool again = i > 0 && sorted[i].row == sorted[i - 1].row && sorted[i].col == sorted[i - 1].col;
    if (again) {
      m.value.back() += sorted[i].value;
      continue;
    }
    m.row.push_back(sorted[i].row);
    m.value.push_back(sorted[i].value);
    ++m.begin[at(sorted[i].col) + 1];
  }
  for (std::size_t j = 0; j < at(cols); ++j) m.begin[j + 1] += m.begin[j];
  return m;
}

void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  for (int j = 0; j < a.cols; ++j) {
    const double factor = x[at(j)];
    for (int k = a.begin[at(j)]; k < a.begin[at(j) + 1]; ++k) y[at(a.row[at(k)])] += a.value[at(k)] * factor;
  }
}

void multiply_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  add_transposed(a, x, y);
}

void add_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
  for (int j = 0; j < a.cols; ++j) {
    double sum = 0.0;
    for (int k = a.begin[at(j)]; k < a.begin[at(j) + 1]; ++k) sum += a.value[at(k)] * x[at(a.row[at(k)])];
    y[at(j)] += sum;
  }
}

void multiply_symmetric(const SparseMatrix& upper, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  for (int j = 0; j < upper.cols; ++j) {
    const double factor = x[at(j)];
    double sum = 0.0;
    for (int k = upper.begin[at(j)]; k < upper.begin[at(j) + 1]; ++k) {
      const int i = upper.row[at(k)];
      if (i != j) y[at(i)] += upper.value[at(k)] * factor;
      sum += upper.value[at(k)] * x[at(i)];
    }
    y[at(j)] += sum;
  }
}

double largest(std::span<const double> x) {
  double m = 0.0;
  for (const double v : x)
    if (std::abs(v) > m || v != v) m = std::abs(v);  // once not a number, m stays so
  return m == m ? m : std::numeric_limits<double>::infinity();
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  const double *pa = a.data(), *pb = b.data();
  const std::size_t n = a.size();
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += pa[i] * pb[i];
  return sum;
}

}  // namespace seine::optim
