#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/optim/qp.hpp"

namespace seine::optim {
namespace {

constexpr std::uint64_t kSeed = 20281;

struct Dense {
  int rows, cols;
  std::vector<double> value;
  double& at(int i, int j) { return value[static_cast<std::size_t>(i * cols + j)]; }
  double at(int i, int j) const { return value[static_cast<std::size_t>(i * cols + j)]; }
};

Dense zeros(int rows, int cols) {
  return {rows, cols, std::vector<double>(static_cast<std::size_t>(rows * cols))};
}

SparseMatrix sparse(const Dense& m, bool upper_only) {
  std::vector<Triplet> triplets;
  for (int i = 0; i < m.rows; ++i)
    for (int j = upper_only ? i : 0; j < m.cols; ++j)
      if (m.at(i, j) != 0.0) triplets.push_back({i, j, m.at(i, j)});
  return from_triplets(m.rows, m.cols, triplets);
}

// P = BᵀB (+ regularisation), feasible by construction around a random point; bounds of every kind.
QpProblem random_problem(Rng& rng, int n, int m, double regularisation) {
  Dense b = zeros(n, n), p = zeros(n, n), a = zeros(m, n);
  for (double& v : b.value) v = rng.normal();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) p.at(i, j) += b.at(k, i) * b.at(k, j) / n;
  for (int i = 0; i < n; ++i) p.at(i, i) += regularisation;
  for (double& v : a.value) v = rng.uniform(0.0, 1.0) < 0.7 ? rng.normal() : 0.0;
  QpProblem problem{.P = sparse(p, true), .q = {}, .A = sparse(a, false), .lower = {}, .upper = {}};
  std::vector<double> inside(static_cast<std::size_t>(n)), ax(static_cast<std::size_t>(m));
  for (double& v : inside) v = rng.normal();
  for (int j = 0; j < n; ++j) problem.q.push_back(2.0 * rng.normal());
  multiply(problem.A, inside, ax);
  for (const double v : ax) {
    const int kind = rng.below(6);
    problem.lower.push_back(kind == 0 ? -HUGE_VAL : kind == 1 ? v : v - rng.uniform(0.0, 1.0));
    problem.upper.push_back(kind == 1 ? v : kind == 2 ? HUGE_VAL : v + rng.uniform(0.0, 1.0));
  }
  return problem;
}

// min over all guesses of active bounds, each solved as a dense linear system: the truth for small problems.
bool solve_dense(Dense m, std::vector<double>& b) {
  const int n = m.rows;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(m.at(i, k)) > std::abs(m.at(pivot, k))) pivot = i;
    if (std::abs(m.at(pivot, k)) < 1e-9) return false;
    for (int j = 0; j < n; ++j) std::swap(m.at(k, j), m.at(pivot, j));
    std::swap(b[static_cast<std::size_t>(k)], b[static_cast<std::size_t>(pivot)]);
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = m.at(i, k) / m.at(k, k);
      for (int j = k; j < n; ++j) m.at(i, j) -= factor * m.at(k, j);
      b[static_cast<std::size_t>(i)] -= factor * b[static_cast<std::size_t>(k)];
    }
  }
  for (int k = 0; k < n; ++k) b[static_cast<std::size_t>(k)] /= m.at(k, k);
  return true;
}

double brute_force(const QpProblem& problem) {
  const int n = problem.variables(), m = problem.rows();
  double best = HUGE_VAL;
  const int guesses = static_cast<int>(std::pow(3, m));
  std::vector<double> x(static_cast<std::size_t>(n)), y(static_cast<std::size_t>(m));
  for (int guess = 0; guess < guesses; ++guess) {
    std::vector<int> active;
    std::vector<double> rhs;
    for (int j = 0; j < n; ++j) rhs.push_back(-problem.q[static_cast<std::size_t>(j)]);
    bool possible = true;
    for (int i = 0, code = guess; i < m; ++i, code /= 3) {
      if (code % 3 == 0) continue;
      const double bound = (code % 3 == 1 ? problem.lower : problem.upper)[static_cast<std::size_t>(i)];
      possible = possible && std::isfinite(bound);
      active.push_back(i), rhs.push_back(bound);
    }
    if (!possible || active.size() > static_cast<std::size_t>(n)) continue;
    Dense k = zeros(n + static_cast<int>(active.size()), n + static_cast<int>(active.size()));
    const auto entries = [](const SparseMatrix& s, auto&& visit) {
      for (int j = 0; j < s.cols; ++j)
        for (int e = s.begin[static_cast<std::size_t>(j)]; e < s.begin[static_cast<std::size_t>(j) + 1]; ++e)
          visit(s.row[static_cast<std::size_t>(e)], j, s.value[static_cast<std::size_t>(e)]);
    };
    entries(problem.P, [&](int i, int j, double v) { k.at(i, j) = k.at(j, i) = v; });
    entries(problem.A, [&](int i, int j, double v) {
      for (int r = 0; r < static_cast<int>(active.size()); ++r)
        if (active[static_cast<std::size_t>(r)] == i) k.at(n + r, j) = k.at(j, n + r) = v;
    });
    if (!solve_dense(k, rhs)) continue;
    std::copy_n(rhs.begin(), n, x.begin());
    std::fill(y.begin(), y.end(), 0.0);
    const KktResiduals r = kkt_residuals(problem, x, y);
    if (r.primal < 1e-9) best = std::min(best, r.objective);
  }
  return best;
}

TEST(Qp, FindsTheMinimumThatTryingAllActiveSetsFinds) {
  Rng rng(kSeed);
  for (int i = 0; i < 300; ++i) {
    const QpProblem problem = random_problem(rng, 1 + rng.below(4), 1 + rng.below(6), 0.1);
    const auto solver = make_qp_solver(problem);
    ASSERT_EQ(solver->solve().status, QpStatus::solved) << "seed " << kSeed << ", case " << i;
    const KktResiduals kkt = kkt_residuals(problem, solver->x(), solver->y());
    EXPECT_LT(kkt.primal, 1e-8);
    EXPECT_LT(kkt.dual, 1e-7);
    EXPECT_NEAR(kkt.objective, brute_force(problem), 1e-7 * (1.0 + std::abs(kkt.objective)))
        << "seed " << kSeed << ", case " << i;
  }
}

TEST(Qp, ResidualsVanishOnLargerProblemsWithAndWithoutCurvature) {
  Rng rng(kSeed + 1);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    QpProblem problem = random_problem(rng, 10 + rng.below(30), 10 + rng.below(60), 0.0);
    // No curvature, but a box: a linear programme.
    if (i % 3 == 0) std::fill(problem.P.value.begin(), problem.P.value.end(), 0.0);
    for (std::size_t k = 0; k < problem.lower.size(); ++k)
      problem.lower[k] = std::max(problem.lower[k], -50.0),
      problem.upper[k] = std::min(problem.upper[k], 50.0);
    if (i % 3 == 0 && problem.rows() < 2 * problem.variables()) continue;
    const auto solver = make_qp_solver(problem);
    const QpSummary summary = solver->solve();
    if (summary.status == QpStatus::dual_infeasible) continue;  // rows need not bound all directions
    ASSERT_EQ(summary.status, QpStatus::solved) << "seed " << kSeed + 1 << ", case " << i;
    const KktResiduals kkt = kkt_residuals(problem, solver->x(), solver->y());
    worst = std::max({worst, kkt.primal, kkt.dual, kkt.gap});
  }
  std::printf("worst residual %.1e\n", worst);
  EXPECT_LT(worst, 1e-5);
}

TEST(Qp, ProvesThatThereIsNoFeasiblePoint) {
  Rng rng(kSeed + 2);
  for (int i = 0; i < 100; ++i) {
    QpProblem problem = random_problem(rng, 2 + rng.below(10), 3 + rng.below(10), 0.0);
    // A random combination of the rows is asked to be larger than the rows allow.
    const std::size_t m = problem.lower.size();
    std::vector<double> weight(m), row(problem.q.size());
    double most = 0.0;
    for (std::size_t k = 0; k < m; ++k) {
      if (std::isinf(problem.upper[k])) problem.upper[k] = problem.lower[k] + 1.0;
      weight[k] = rng.uniform(0.1, 1.0), most += weight[k] * problem.upper[k];
    }
    multiply_transposed(problem.A, weight, row);
    std::vector<Triplet> triplets;
    for (int j = 0; j < problem.A.cols; ++j)
      for (int e = problem.A.begin[static_cast<std::size_t>(j)];
           e < problem.A.begin[static_cast<std::size_t>(j) + 1]; ++e)
        triplets.push_back(
            {problem.A.row[static_cast<std::size_t>(e)], j, problem.A.value[static_cast<std::size_t>(e)]});
    for (int j = 0; j < problem.A.cols; ++j)
      triplets.push_back({static_cast<int>(m), j, row[static_cast<std::size_t>(j)]});
    problem.A = from_triplets(static_cast<int>(m) + 1, problem.A.cols, triplets);
    problem.lower.push_back(most + rng.uniform(0.01, 1.0));
    problem.upper.push_back(HUGE_VAL);

    const auto solver = make_qp_solver(problem);
    ASSERT_EQ(solver->solve().status, QpStatus::primal_infeasible) << "seed " << kSeed + 2 << ", case " << i;
    // The certificate: y with Aᵀy = 0 whose support is negative.
    std::vector<double> aty(problem.q.size());
    multiply_transposed(problem.A, solver->y(), aty);
    double support = 0.0;
    for (std::size_t k = 0; k <= m; ++k)
      if (const double y = solver->y()[k]; y != 0.0)
        support += y * (y > 0.0 ? problem.upper[k] : problem.lower[k]);
    EXPECT_LT(support, 0.0);
    EXPECT_LT(largest(aty), 1e-6 * -support);
  }
}

TEST(Qp, ProvesThatTheCostHasNoEnd) {
  Rng rng(kSeed + 3);
  for (int i = 0; i < 100; ++i) {
    QpProblem problem = random_problem(rng, 3 + rng.below(6), 2 + rng.below(6), 0.0);
    // The first variable only ever helps, and nothing holds it on that side.
    for (int e = 0; e < problem.P.entries(); ++e) {
      int column = 0;
      while (problem.P.begin[static_cast<std::size_t>(column) + 1] <= e) ++column;
      if (problem.P.row[static_cast<std::size_t>(e)] == 0 || column == 0)
        problem.P.value[static_cast<std::size_t>(e)] = 0.0;
    }
    problem.q[0] = -1.0;
    for (int e = problem.A.begin[0]; e < problem.A.begin[1]; ++e) {
      const auto row = static_cast<std::size_t>(problem.A.row[static_cast<std::size_t>(e)]);
      const double value = problem.A.value[static_cast<std::size_t>(e)];
      (value > 0.0 ? problem.upper[row] = HUGE_VAL : problem.lower[row] = -HUGE_VAL);
    }
    const auto solver = make_qp_solver(problem);
    ASSERT_EQ(solver->solve().status, QpStatus::dual_infeasible) << "seed " << kSeed + 3 << ", case " << i;
    std::vector<double> px(problem.q.size());
    multiply_symmetric(problem.P, solver->x(), px);
    EXPECT_LT(dot(problem.q, solver->x()), 0.0);
    EXPECT_LT(largest(px), 1e-6 * -dot(problem.q, solver->x()));
  }
}

TEST(Qp, SaysThatACostIsNotConvex) {
  QpProblem problem;
  problem.P = from_triplets(2, 2, std::vector<Triplet>{{0, 0, 1.0}, {1, 1, -1.0}});
  problem.q = {0.0, 0.0};
  problem.A = from_triplets(1, 2, std::vector<Triplet>{{0, 0, 1.0}});
  problem.lower = {-1.0}, problem.upper = {1.0};
  EXPECT_EQ(make_qp_solver(problem)->solve().status, QpStatus::not_convex);
}

TEST(Qp, UpdatesAndWarmStartsReachTheSameSolutionInFewerSteps) {
  Rng rng(kSeed + 4);
  int cold = 0, warm = 0;
  for (int i = 0; i < 30; ++i) {
    QpProblem problem = random_problem(rng, 20, 40, 0.05);
    const auto solver = make_qp_solver(problem);
    solver->solve();
    for (int step = 0; step < 5; ++step) {
      for (double& v : problem.q) v += 0.02 * rng.normal();
      for (double& v : problem.A.value) v *= 1.0 + 0.001 * rng.normal();
      solver->update(problem);
      const QpSummary again = solver->solve();
      const auto fresh = make_qp_solver(problem);
      const QpSummary first = fresh->solve();
      if (first.status != QpStatus::solved) continue;  // the change may have made it infeasible
      ASSERT_EQ(again.status, QpStatus::solved);
      warm += again.iterations, cold += first.iterations;
      for (std::size_t j = 0; j < problem.q.size(); ++j) EXPECT_NEAR(solver->x()[j], fresh->x()[j], 1e-5);
    }
  }
  std::printf("iterations: cold %d, warm %d\n", cold, warm);
  EXPECT_LT(warm, cold / 4);
}

TEST(Qp, UnitsOfRowsAndVariablesDoNotMatter) {
  Rng rng(kSeed + 5);
  for (int i = 0; i < 30; ++i) {
    const QpProblem problem = random_problem(rng, 8, 15, 0.1);
    QpProblem other = problem;
    for (int j = 0; j < other.A.cols; ++j)
      for (int e = other.A.begin[static_cast<std::size_t>(j)];
           e < other.A.begin[static_cast<std::size_t>(j) + 1]; ++e)
        other.A.value[static_cast<std::size_t>(e)] *=
            std::pow(10.0, other.A.row[static_cast<std::size_t>(e)] % 5 - 2);
    for (std::size_t k = 0; k < other.lower.size(); ++k) {
      const double scale = std::pow(10.0, static_cast<double>(k % 5) - 2.0);
      other.lower[k] *= scale, other.upper[k] *= scale;
    }
    const auto a = make_qp_solver(problem), b = make_qp_solver(other);
    ASSERT_EQ(a->solve().status, QpStatus::solved);
    ASSERT_EQ(b->solve().status, QpStatus::solved);
    for (std::size_t j = 0; j < problem.q.size(); ++j) EXPECT_NEAR(a->x()[j], b->x()[j], 1e-6);
  }
}

TEST(Qp, RefusesWhatIsNoProblem) {
  Rng rng(kSeed + 6);
  const QpProblem good = random_problem(rng, 4, 5, 0.1);
  const auto refuses = [&](auto&& spoil) {
    QpProblem bad = good;
    spoil(bad);
    EXPECT_FALSE(bad.complaints().empty());
    EXPECT_THROW(make_qp_solver(bad), InputError);
  };
  EXPECT_EQ(good.complaints(), "");
  refuses([](QpProblem& p) { p.q[1] = NAN; });
  refuses([](QpProblem& p) { p.q.pop_back(); });
  refuses([](QpProblem& p) { p.lower[2] = 1.0, p.upper[2] = 0.0; });
  refuses([](QpProblem& p) { p.upper[0] = NAN; });
  refuses([](QpProblem& p) { p.lower[0] = HUGE_VAL, p.upper[0] = HUGE_VAL; });
  refuses([](QpProblem& p) { p.upper.pop_back(); });
  refuses([](QpProblem& p) { p.A.value[0] = HUGE_VAL; });
  refuses([](QpProblem& p) { p.A.row[0] = 99; });
  refuses([](QpProblem& p) { p.P = from_triplets(4, 4, std::vector<Triplet>{{1, 0, 1.0}}); });
  const auto solver = make_qp_solver(good);
  QpProblem other = good;
  other.A = from_triplets(5, 4, std::vector<Triplet>{{0, 0, 1.0}});
  EXPECT_THROW(solver->update(other), InputError);
  if (!available(QpBackend::osqp)) {
    EXPECT_THROW(make_qp_solver(good, {.backend = QpBackend::osqp}), InputError);
  }
}

TEST(Qp, EmptyThingsAreFine) {
  QpProblem free{.P = from_triplets(2, 2, std::vector<Triplet>{{0, 0, 1.0}, {1, 1, 2.0}}),
                 .q = {1.0, 2.0},
                 .A = from_triplets(0, 2, {}),
                 .lower = {},
                 .upper = {}};
  const auto solver = make_qp_solver(free);
  EXPECT_EQ(solver->solve().status, QpStatus::solved);
  EXPECT_NEAR(solver->x()[0], -1.0, 1e-9);
  EXPECT_NEAR(solver->x()[1], -1.0, 1e-9);
}

TEST(Qp, TheSameInputGivesTheSameBits) {
  Rng rng(kSeed + 7);
  const QpProblem problem = random_problem(rng, 20, 40, 0.01);
  const auto a = make_qp_solver(problem), b = make_qp_solver(problem);
  a->solve(), b->solve();
  EXPECT_TRUE(std::equal(a->x().begin(), a->x().end(), b->x().begin()));
  EXPECT_TRUE(std::equal(a->y().begin(), a->y().end(), b->y().begin()));
}

}  // namespace
}  // namespace seine::optim
