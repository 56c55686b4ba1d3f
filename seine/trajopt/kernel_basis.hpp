#pragma once

namespace seine::trajopt {

/// The powers at the samples of a piece: value[d][k][j] = d-th derivative of w^k at w = j / Lanes.
template <int Lanes>
struct Basis {
  alignas(64) double value[3][6][Lanes];
  constexpr Basis() : value{} {
    for (int j = 0; j < Lanes; ++j) {
      const double w = static_cast<double>(j) / Lanes;
      double power = 1.0;
      for (int k = 0; k < 6; ++k) {
        value[0][k][j] = power;
        if (k + 1 < 6) value[1][k + 1][j] = (k + 1) * power;
        if (k + 2 < 6) value[2][k + 2][j] = (k + 1) * (k + 2) * power;
        power *= w;
      }
    }
  }
};

}  // namespace seine::trajopt
