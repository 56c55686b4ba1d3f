#pragma once

#include <array>
#include <cstddef>

namespace seine::sim {

/// A matrix whose size is known when it is compiled, by rows.
template <std::size_t Rows, std::size_t Columns>
using SmallMatrix = std::array<std::array<double, Columns>, Rows>;

template <std::size_t Size>
SmallMatrix<Size, Size> identity() {
  SmallMatrix<Size, Size> matrix{};
  for (std::size_t i = 0; i < Size; ++i) matrix[i][i] = 1.0;
  return matrix;
}

/// M P Mᵀ: the covariance of M x when P is that of x.
template <std::size_t Rows, std::size_t Size>
SmallMatrix<Rows, Rows> carried(const SmallMatrix<Rows, Size>& m, const SmallMatrix<Size, Size>& p) {
  SmallMatrix<Rows, Size> half{};
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t l = 0; l < Size; ++l)
      for (std::size_t j = 0; j < Size; ++j) half[i][j] += m[i][l] * p[l][j];
  SmallMatrix<Rows, Rows> full{};
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t j = 0; j < Rows; ++j)
      for (std::size_t l = 0; l < Size; ++l) full[i][j] += half[i][l] * m[j][l];
  return full;
}

}  // namespace seine::sim
