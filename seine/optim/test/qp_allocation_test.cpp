// After the set-up the solver allocates nothing: every way to get memory is counted. Under the sanitizers,
// which have their own allocator, there is nothing to count.
#ifndef SEINE_SANITIZED
#include <gtest/gtest.h>

#include "seine/base/count_allocations.hpp"
#include "seine/optim/test/qp_file.hpp"

namespace seine::optim {
namespace {

TEST(QpAllocation, TheCountSeesAnAllocation) {
  const long before = allocations;
  const auto one = std::make_unique<std::vector<double>>(1000);
  EXPECT_GE(allocations - before, 2) << one->size();
}

TEST(QpAllocation, NothingAfterTheSetUp) {
  std::vector<ReferenceQp> all = maros_meszaros();
  for (ReferenceQp& reference : walking_and_balancing()) all.push_back(std::move(reference));
  for (ReferenceQp& reference : all) {
    const auto solver = make_qp_solver(reference.problem);
    QpProblem other = reference.problem;
    for (double& v : other.q) v *= 1.01;
    const long before = allocations;
    solver->solve();  // splitting, polish, and interior point method where it needs that
    solver->update(other);
    solver->solve();
    solver->warm_start(solver->x(), solver->y());
    solver->solve();
    EXPECT_EQ(allocations - before, 0) << reference.name;
  }
}

}  // namespace
}  // namespace seine::optim
#endif
