#include "seine/baseline/letter/quadrature.hpp"

namespace seine::baseline::letter {

Quadrature::Node basis_at(double w) {
  const double w2 = w * w, w3 = w2 * w, w4 = w2 * w2;
  return {w,
          1.0,
          {1.0, w, w2, w3, w4, w4 * w},
          {0.0, 1.0, 2.0 * w, 3.0 * w2, 4.0 * w3, 5.0 * w4},
          {0.0, 0.0, 2.0, 6.0 * w, 12.0 * w2, 20.0 * w3}};
}

Quadrature::Quadrature(int intervals) {
  for (int i = 0; i <= intervals; ++i) {
    nodes.push_back(basis_at(static_cast<double>(i) / intervals));
    nodes.back().weight = (i == 0 || i == intervals ? 0.5 : 1.0) / intervals;
  }
}

}  // namespace seine::baseline::letter
