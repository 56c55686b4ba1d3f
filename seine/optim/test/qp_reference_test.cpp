// Other people's problems with other people's answers.
#include <gtest/gtest.h>

#include <cmath>

#include "seine/optim/test/qp_file.hpp"

namespace seine::optim {
namespace {

// The published optima have eight digits; HS268 and S268 have the optimum 0, published with a rounding error
// of 5.7e-7.
constexpr double kObjective = 1e-6, kFeasible = 1e-6;

struct Worst {
  double objective = 0.0, primal = 0.0, dual = 0.0;
  int iterations = 0, factorisations = 0;
};

// Judged by recomputed residuals and the published optimum, not by what the solver says of itself.
void judge(const ReferenceQp& reference, const QpOptions& options, Worst& worst) {
  const auto solver = make_qp_solver(reference.problem, options);
  const QpSummary summary = solver->solve();
  const KktResiduals kkt = kkt_residuals(reference.problem, solver->x(), solver->y());
  const double error = std::abs(kkt.objective + reference.constant - reference.optimum) /
                       std::max(1.0, std::abs(reference.optimum));
  const double dual = kkt.dual / (1.0 + largest(reference.problem.q));
  EXPECT_EQ(summary.status, QpStatus::solved) << reference.name;
  EXPECT_LE(error, kObjective) << reference.name;
  EXPECT_LE(kkt.primal, kFeasible) << reference.name;
  EXPECT_LE(dual, 1e-6) << reference.name;
  worst.objective = std::max(worst.objective, error);
  worst.primal = std::max(worst.primal, kkt.primal);
  worst.dual = std::max(worst.dual, dual);
  worst.iterations = std::max(worst.iterations, summary.iterations);
  worst.factorisations = std::max(worst.factorisations, summary.factorisations);
}

void judge_all(const std::vector<ReferenceQp>& all, const QpOptions& options) {
  Worst worst;
  for (const ReferenceQp& reference : all) judge(reference, options, worst);
  std::printf(
      "%zu problems; worst objective %.1e, bounds %.1e, gradient %.1e, iterations %d, factorisations %d\n",
      all.size(), worst.objective, worst.primal, worst.dual, worst.iterations, worst.factorisations);
}

TEST(QpReference, MarosAndMeszaros) {
  const auto all = maros_meszaros();
  ASSERT_GE(all.size(), 30u);
  judge_all(all, {});
}

TEST(QpReference, WalkingAndBalancing) {
  const auto all = walking_and_balancing();
  ASSERT_GE(all.size(), 30u);
  judge_all(all, {});
}

// What splitting does without help, to its own tolerance.
TEST(QpReference, WalkingAndBalancingBySplittingAlone) {
  for (const ReferenceQp& reference : walking_and_balancing()) {
    const auto solver = make_qp_solver(reference.problem, {.polish = false});
    EXPECT_EQ(solver->solve().status, QpStatus::solved) << reference.name;
    const KktResiduals kkt = kkt_residuals(reference.problem, solver->x(), solver->y());
    EXPECT_LE(kkt.primal, 2e-5) << reference.name;
    EXPECT_NEAR(kkt.objective, reference.optimum, 1e-3 * (1.0 + std::abs(reference.optimum)))
        << reference.name;
  }
}

TEST(QpReference, BothBackendsAgree) {
  if (!available(QpBackend::osqp)) GTEST_SKIP() << "OSQP is not installed";
  std::vector<ReferenceQp> all = walking_and_balancing();
  for (const ReferenceQp& reference : maros_meszaros())
    if (reference.name.starts_with("HS") || reference.name.starts_with("CVXQP") || reference.name == "QAFIRO")
      all.push_back(reference);
  int both = 0;
  for (const ReferenceQp& reference : all) {
    const auto own = make_qp_solver(reference.problem),
               osqp = make_qp_solver(reference.problem, {.backend = QpBackend::osqp});
    EXPECT_EQ(own->solve().status, QpStatus::solved) << reference.name;
    // It takes some problems with rows of zeros for infeasible.
    if (osqp->solve().status != QpStatus::solved) continue;
    ++both;
    const double objective = kkt_residuals(reference.problem, own->x(), own->y()).objective;
    EXPECT_NEAR(objective, kkt_residuals(reference.problem, osqp->x(), osqp->y()).objective,
                1e-4 * (1.0 + std::abs(objective)))
        << reference.name;
  }
  std::printf("solved by both: %d of %zu\n", both, all.size());
  EXPECT_GE(both, 35);
}

}  // namespace
}  // namespace seine::optim
