#pragma once

#include <memory>
#include <span>

#include "seine/optim/qp_sparse.hpp"

namespace seine::optim {

/// The system   [ P + diag(d)   Aᵀ      ] [x]   [b_x]
///              [ A            −diag(e) ] [y] = [b_y],   d > 0, e > 0:
/// quasi-definite, so LDLᵀ exists for every order of elimination; fill is kept low by approximate minimum
/// degree, by the pattern alone. Order and pattern are fixed at construction; afterwards nothing allocates.
class KktSystem {
 public:
  /// @param upper upper triangle of P; of both only the pattern is read
  KktSystem(const SparseMatrix& upper, const SparseMatrix& a);
  ~KktSystem();

  /// Takes the numbers and factorises. @param rows_kept A's rows with a zero here count as zero; empty: all
  /// are kept. Returns whether the signs of D are those of a problem that is convex on the rows kept: n
  /// positive, m negative.
  bool factorise(const SparseMatrix& upper, const SparseMatrix& a, std::span<const double> d,
                 std::span<const double> e, std::span<const char> rows_kept = {});
  /// Solves in place: b_x in x, b_y in y.
  void solve(std::span<double> x, std::span<double> y);
  int entries() const;  ///< of L below the diagonal

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seine::optim
