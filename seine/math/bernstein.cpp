#include "seine/math/bernstein.hpp"

#include <algorithm>
#include <cassert>

namespace seine::math {
namespace {

constexpr int kRows = Bernstein::kMaxDegree + 1;
using Table = std::array<std::array<double, kRows>, kRows>;

/// C(n, k); every entry is an integer below 2^53, so exact.
constexpr Table pascal() {
  Table c{};
  for (std::size_t n = 0; n < kRows; ++n) {
    c[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) c[n][k] = c[n - 1][k - 1] + (k < n ? c[n - 1][k] : 0.0);
  }
  return c;
}
constexpr Table kBinomial = pascal();

const std::array<double, kRows>& binomials(int n) {
  return kBinomial[static_cast<std::size_t>(n)];
}

}  // namespace

Bernstein Bernstein::from_power(std::span<const double> c) {
  assert(!c.empty() && c.size() <= kRows);
  Bernstein f;
  f.degree_ = static_cast<int>(c.size()) - 1;
  const auto& of_n = binomials(f.degree_);
  for (std::size_t i = 0; i < c.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k <= i; ++k) sum += kBinomial[i][k] / of_n[k] * c[k];
    f.b_[i] = sum;
  }
  return f;
}

Bernstein Bernstein::from_coefficients(std::span<const double> b) {
  assert(!b.empty() && b.size() <= kRows);
  Bernstein f;
  f.degree_ = static_cast<int>(b.size()) - 1;
  std::copy(b.begin(), b.end(), f.b_.begin());
  return f;
}

void Bernstein::to_power(std::span<double> c) const {
  assert(c.size() == coefficients().size());
  const auto& of_n = binomials(degree_);
  for (std::size_t k = 0; k < c.size(); ++k) {
    double difference = 0.0;  // Δ^k b_0
    for (std::size_t i = 0; i <= k; ++i)
      difference += ((k - i) % 2 == 0 ? 1.0 : -1.0) * kBinomial[k][i] * b_[i];
    c[k] = of_n[k] * difference;
  }
}

double Bernstein::operator()(double w) const {
  auto row = b_;
  for (int left = degree_; left > 0; --left) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(left); ++i)
      row[i] = (1.0 - w) * row[i] + w * row[i + 1];
  }
  return row[0];
}

Bernstein Bernstein::derivative() const {
  Bernstein d;
  if (degree_ == 0) return d;
  d.degree_ = degree_ - 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(degree_); ++i) d.b_[i] = degree_ * (b_[i + 1] - b_[i]);
  return d;
}

double Bernstein::lower_bound() const {
  return *std::min_element(b_.begin(), b_.begin() + degree_ + 1);
}

double Bernstein::upper_bound() const {
  return *std::max_element(b_.begin(), b_.begin() + degree_ + 1);
}

std::pair<Bernstein, Bernstein> Bernstein::split(double at) const {
  Bernstein left, right = *this;
  left.degree_ = degree_;
  const auto n = static_cast<std::size_t>(degree_);
  for (std::size_t level = 0; level <= n; ++level) {
    left.b_[level] = right.b_[0];
    for (std::size_t i = 0; i + level < n; ++i) right.b_[i] = (1.0 - at) * right.b_[i] + at * right.b_[i + 1];
  }
  return {left, right};
}

Bernstein Bernstein::restricted(double low, double high) const {
  // Cutting the larger part first keeps both parameters inside [0, 1].
  if (high > 0.0) return split(high).first.split(low / high).second;
  return split(low).second.split((high - low) / (1.0 - low)).first;
}

Bernstein Bernstein::elevated(int degree) const {
  assert(degree >= degree_ && degree <= kMaxDegree);
  Bernstein f = *this;
  while (f.degree_ < degree) {
    const double n = ++f.degree_;
    for (int i = f.degree_; i >= 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      const double share = i / n;
      f.b_[at] = (i > 0 ? share * f.b_[at - 1] : 0.0) + (i < f.degree_ ? (1.0 - share) * f.b_[at] : 0.0);
    }
  }
  return f;
}

Bernstein operator*(const Bernstein& f, const Bernstein& g) {
  assert(f.degree_ + g.degree_ <= Bernstein::kMaxDegree);
  Bernstein h;
  h.degree_ = f.degree_ + g.degree_;
  const auto &of_f = binomials(f.degree_), &of_g = binomials(g.degree_), &of_h = binomials(h.degree_);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(f.degree_); ++i) {
    const double scaled = of_f[i] * f.b_[i];
    for (std::size_t j = 0; j <= static_cast<std::size_t>(g.degree_); ++j) {
      h.b_[i + j] += scaled * of_g[j] * g.b_[j] / of_h[i + j];
    }
  }
  return h;
}

Bernstein operator+(const Bernstein& f, const Bernstein& g) {
  const int degree = std::max(f.degree_, g.degree_);
  Bernstein h = f.elevated(degree);
  const Bernstein k = g.elevated(degree);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(degree); ++i) h.b_[i] += k.b_[i];
  return h;
}

Bernstein operator-(const Bernstein& f, const Bernstein& g) {
  return f + (-1.0) * g;
}

Bernstein operator*(double s, Bernstein f) {
  for (double& b : f.b_) b *= s;
  return f;
}

}  // namespace seine::math
