#pragma once

#include <span>
#include <vector>

namespace seine::optim {

/// A sparse matrix in compressed columns: the entries of column j stand at begin[j] … begin[j + 1] − 1, rows
/// ascending.
struct SparseMatrix {
  int rows = 0, cols = 0;
  std::vector<int> begin{0};  ///< cols + 1
  std::vector<int> row;
  std::vector<double> value;

  int entries() const { return static_cast<int>(row.size()); }
};

struct Triplet {
  int row, col;
  double value;
};

/// Entries at the same place are added up; zeros stay, so that the pattern can be chosen. Throws InputError
/// for an index outside.
SparseMatrix from_triplets(int rows, int cols, std::span<const Triplet> triplets);

/// y = A x.
void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y);
/// y = Aᵀ x.
void multiply_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y);
/// y += Aᵀ x.
void add_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y);
/// y = P x, `upper` the upper triangle (with diagonal) of the symmetric P.
void multiply_symmetric(const SparseMatrix& upper, std::span<const double> x, std::span<double> y);

/// max |x_i|; 0 for nothing, infinite as soon as an entry is not a number.
double largest(std::span<const double> x);
double dot(std::span<const double> a, std::span<const double> b);

}  // namespace seine::optim
