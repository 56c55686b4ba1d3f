#include "seine/optim/qp_kkt.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cassert>
#include <vector>

namespace seine::optim {
namespace {

using EigenMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Eigen's factorisation, entered where it neither orders nor copies, and therefore does not allocate.
class Ldlt : public Eigen::SimplicialLDLT<EigenMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
 public:
  void refactorise(const EigenMatrix& ordered) { factorize_preordered<true>(ordered); }
  const EigenMatrix& factor() const { return m_matrix; }
  const Eigen::VectorXd& diagonal() const { return m_diag; }
  bool succeeded() const { return m_factorizationIsOk && m_info == Eigen::Success; }
};

// Column and row of every entry of the system's upper triangle, in the order: P, its diagonal again, A, −e.
std::vector<Triplet> places(const SparseMatrix& upper, const SparseMatrix& a) {
  std::vector<Triplet> all;
  const auto list = [&](const SparseMatrix& m, bool transposed, int offset) {
    for (int j = 0; j < m.cols; ++j)
      for (int k = m.begin[at(j)]; k < m.begin[at(j) + 1]; ++k)
        transposed ? all.push_back({j, offset + m.row[at(k)], 1.0}) : all.push_back({m.row[at(k)], j, 1.0});
  };
  const int n = upper.cols, m = a.rows;
  list(upper, false, 0);
  for (int j = 0; j < n; ++j) all.push_back({j, j, 1.0});
  list(a, true, n);
  for (int i = 0; i < m; ++i) all.push_back({n + i, n + i, 1.0});
  return all;
}

EigenMatrix to_eigen(const SparseMatrix& m) {
  EigenMatrix result(m.rows, m.cols);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int j = 0; j < m.cols; ++j)
    for (int k = m.begin[at(j)]; k < m.begin[at(j) + 1]; ++k)
      triplets.emplace_back(m.row[at(k)], j, m.value[at(k)]);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

// Where each variable of the system goes: new place of old index.
std::vector<int> fill_reducing_order(int size, const std::vector<Triplet>& entries) {
  const EigenMatrix pattern = to_eigen(from_triplets(size, size, entries));
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Upper>(), order);
  // The method names the old index of every new one.
  std::vector<int> place(at(size));
  for (int i = 0; i < size; ++i) place[at(order.indices()[i])] = i;
  return place;
}

}  // namespace

struct KktSystem::Impl {
  int n = 0, m = 0;
  std::vector<int> place;   // new index of old
  EigenMatrix ordered;      // upper triangle of the system, in the new order
  std::vector<int> target;  // in its values: of P's entries, the diagonal, A's entries, the lower diagonal
  Ldlt ldlt;
  std::vector<double> work;
};

KktSystem::KktSystem(const SparseMatrix& upper, const SparseMatrix& a) : impl_(std::make_unique<Impl>()) {
  Impl& s = *impl_;
  s.n = upper.cols, s.m = a.rows;
  const int size = s.n + s.m;
  std::vector<Triplet> entries = places(upper, a);
  s.place = fill_reducing_order(size, entries);
  for (Triplet& t : entries) {
    const int i = s.place[at(t.row)], j = s.place[at(t.col)];
    t.row = std::min(i, j), t.col = std::max(i, j);
  }
  const SparseMatrix merged = from_triplets(size, size, entries);
  for (const Triplet& t : entries) {
    const auto from = merged.row.begin() + merged.begin[at(t.col)],
               to = merged.row.begin() + merged.begin[at(t.col) + 1];
    s.target.push_back(static_cast<int>(std::lower_bound(from, to, t.row) - merged.row.begin()));
  }
  s.ordered = to_eigen(merged);
  s.ordered.makeCompressed();
  s.ldlt.analyzePattern(s.ordered);
  s.ldlt.refactorise(s.ordered);  // of whatever: the first time takes memory
  s.work.resize(at(size));
}

KktSystem::~KktSystem() = default;

int KktSystem::entries() const {
  return static_cast<int>(impl_->ldlt.factor().nonZeros());
}

bool KktSystem::factorise(const SparseMatrix& upper, const SparseMatrix& a, std::span<const double> d,
                          std::span<const double> e, std::span<const char> rows_kept) {
  Impl& s = *impl_;
  double* value = s.ordered.valuePtr();
  std::fill(value, value + s.ordered.nonZeros(), 0.0);
  const int* target = s.target.data();
  for (const double v : upper.value) value[*target++] += v;
  for (const double v : d) value[*target++] += v;
  for (std::size_t k = 0; k < a.value.size(); ++k)
    value[*target++] += rows_kept.empty() || rows_kept[at(a.row[k])] ? a.value[k] : 0.0;
  for (const double v : e) value[*target++] -= v;
  s.ldlt.refactorise(s.ordered);
  if (!s.ldlt.succeeded()) return false;
  const auto& diagonal = s.ldlt.diagonal();
  return (diagonal.array() > 0.0).count() == s.n && (diagonal.array() < 0.0).count() == s.m;
}

void KktSystem::solve(std::span<double> x, std::span<double> y) {
  Impl& s = *impl_;
  const int size = s.n + s.m;
  double* w = s.work.data();
  for (int i = 0; i < size; ++i) w[s.place[at(i)]] = i < s.n ? x[at(i)] : y[at(i - s.n)];
  const EigenMatrix& factor = s.ldlt.factor();
  const int *begin = factor.outerIndexPtr(), *row = factor.innerIndexPtr();
  const double *value = factor.valuePtr(), *diagonal = s.ldlt.diagonal().data();
  for (int j = 0; j < size; ++j) {
    const double pivot = w[j];
    for (int k = begin[j]; k < begin[j + 1]; ++k) w[row[k]] -= value[k] * pivot;
  }
  for (int j = size - 1; j >= 0; --j) {
    double sum = w[j] / diagonal[j];
    for (int k = begin[j]; k < begin[j + 1]; ++k) sum -= value[k] * w[row[k]];
    w[j] = sum;
  }
  for (int i = 0; i < size; ++i) (i < s.n ? x[at(i)] : y[at(i - s.n)]) = w[s.place[at(i)]];
}

}  // namespace seine::optim
