#pragma once

#include <array>
#include <vector>

namespace seine::baseline::letter {

/// The trapezoidal rule on one piece: values of the powers of w and their derivatives at every sample.
struct Quadrature {
  struct Node {
    double w;                                    ///< local parameter, 0 … 1, both ends included
    double weight;                               ///< times the piece's duration
    std::array<double, 6> power, first, second;  ///< w^k and its derivatives by w
  };
  std::vector<Node> nodes;

  explicit Quadrature(int intervals);
};

/// w^k and its derivatives by w.
Quadrature::Node basis_at(double w);

}  // namespace seine::baseline::letter
