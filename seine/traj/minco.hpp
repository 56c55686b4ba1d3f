#pragma once

#include <array>
#include <span>
#include <vector>

namespace seine::traj {

/// The minimum-jerk spline through given points, on M pieces of unit length [Wang22, Theorem 2, s = 3]:
/// quintic pieces, C⁴ at the interior knots. With uniform pieces in normalised time the linear system is the
/// same for every trajectory with M pieces, so it is solved once for all right-hand sides and kept as a
/// matrix.
///
/// Rows of the boundary data Z (M + 5 of them): start value, start derivative, start second derivative, the M
/// − 1 interior values, end value, end derivative, end second derivative. Knot data: value, first and second
/// derivative at each of the M + 1 knots.
class UniformMinco {
 public:
  /// The shared, immutable instance for M pieces, 1 ≤ M ≤ kMaxPieces. Thread-safe.
  static const UniformMinco& with(int pieces);
  static constexpr int kMaxPieces = 256;

  int pieces() const { return pieces_; }
  int rows() const { return pieces_ + 5; }

  /// Coefficients of every piece, coefficient-major: out[k · stride + j] is the factor of w^k on piece j.
  /// @param z rows() values of one coordinate
  void coefficients(std::span<const double> z, double* out, int stride) const;
  /// Adjoint: given ∂J/∂coefficients in the same layout, adds ∂J/∂z.
  void add_adjoint(const double* gradient, int stride, std::span<double> gradient_z) const;

 private:
  explicit UniformMinco(int pieces);
  int pieces_;
  std::vector<double>
      inner_;  // 2(M − 1) × (M + 5): first and second derivatives at the interior knots from Z
};

/// ∫₀¹ (f''')² dw of a quintic with coefficients c, and its gradient.
inline double jerk_energy(const std::array<double, 6>& c) {
  return 36 * c[3] * c[3] + 144 * c[3] * c[4] + 192 * c[4] * c[4] + 240 * c[3] * c[5] + 720 * c[4] * c[5] +
         720 * c[5] * c[5];
}
inline std::array<double, 3> jerk_energy_gradient(const std::array<double, 6>& c) {
  return {72 * c[3] + 144 * c[4] + 240 * c[5], 144 * c[3] + 384 * c[4] + 720 * c[5],
          240 * c[3] + 720 * c[4] + 1440 * c[5]};
}

}  // namespace seine::traj
