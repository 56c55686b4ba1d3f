#pragma once

#include <array>
#include <span>
#include <utility>

namespace seine::math {

/// A polynomial in Bernstein form over [0, 1]: f(w) = Σ b_i C(n, i) w^i (1 − w)^(n−i). Its graph lies in the
/// convex hull of the points (i/n, b_i), so the smallest and the largest coefficient bound it; splitting
/// tightens that quadratically [Farouki12]. Fixed size, no allocation.
class Bernstein {
 public:
  static constexpr int kMaxDegree = 32;

  /// The zero polynomial.
  Bernstein() = default;
  /// From Σ c[k] w^k; one to kMaxDegree + 1 coefficients.
  static Bernstein from_power(std::span<const double> c);
  /// From b_0 … b_n.
  static Bernstein from_coefficients(std::span<const double> b);

  int degree() const { return degree_; }
  std::span<const double> coefficients() const { return {b_.data(), static_cast<std::size_t>(degree_) + 1}; }
  /// The power coefficients, as many as coefficients().
  void to_power(std::span<double> c) const;

  /// Value at w by de Casteljau: stable inside [0, 1], defined everywhere.
  double operator()(double w) const;
  Bernstein derivative() const;

  /// A bound that is never above (below) any value over [0, 1]; exact when it is the first or the last
  /// coefficient.
  double lower_bound() const;
  double upper_bound() const;

  /// f over [0, at] and f over [at, 1], each as a polynomial over [0, 1].
  std::pair<Bernstein, Bernstein> split(double at = 0.5) const;
  /// f over [low, high] as a polynomial over [0, 1].
  Bernstein restricted(double low, double high) const;

  /// The same polynomial written with a higher degree.
  Bernstein elevated(int degree) const;

  friend Bernstein operator*(const Bernstein& f, const Bernstein& g);
  friend Bernstein operator+(const Bernstein& f, const Bernstein& g);
  friend Bernstein operator-(const Bernstein& f, const Bernstein& g);
  friend Bernstein operator*(double s, Bernstein f);

 private:
  int degree_ = 0;
  std::array<double, kMaxDegree + 1> b_{};
};

}  // namespace seine::math
