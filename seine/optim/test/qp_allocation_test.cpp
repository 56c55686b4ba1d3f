// After the set-up the solver allocates nothing: every way to get memory is counted. Under the sanitizers,
// which have their own allocator, there is nothing to count.
#ifndef SEINE_SANITIZED
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "seine/optim/test/qp_file.hpp"

namespace {
std::atomic<long> g_allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

// operator new ends in malloc.
void* malloc(std::size_t size) {
  ++g_allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++g_allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++g_allocations;
  return __libc_realloc(old, size);
}
}

namespace seine::optim {
namespace {

TEST(QpAllocation, TheCountSeesAnAllocation) {
  const long before = g_allocations;
  const auto one = std::make_unique<std::vector<double>>(1000);
  EXPECT_GE(g_allocations - before, 2) << one->size();
}

TEST(QpAllocation, NothingAfterTheSetUp) {
  std::vector<ReferenceQp> all = maros_meszaros();
  for (ReferenceQp& reference : walking_and_balancing()) all.push_back(std::move(reference));
  for (ReferenceQp& reference : all) {
    const auto solver = make_qp_solver(reference.problem);
    QpProblem other = reference.problem;
    for (double& v : other.q) v *= 1.01;
    const long before = g_allocations;
    solver->solve();  // splitting, polish, and interior point method where it needs that
    solver->update(other);
    solver->solve();
    solver->warm_start(solver->x(), solver->y());
    solver->solve();
    EXPECT_EQ(g_allocations - before, 0) << reference.name;
  }
}

}  // namespace
}  // namespace seine::optim
#endif
