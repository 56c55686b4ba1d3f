#include "seine/base/workers.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <vector>

namespace seine {
namespace {

TEST(Workers, CallEveryIndexOnceInEveryRound) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    for (int round = 0; round < 2000; ++round) {
      const int count = round % 37;
      std::vector<int> calls(static_cast<std::size_t>(count), 0);
      workers.run(count, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
      for (const int c : calls) ASSERT_EQ(c, 1) << threads << " threads, round " << round;
    }
  }
}

// Rounds of changing size, back to back: a thread that is late in a short round must not take an index of the
// next, longer one with the short round's function.
TEST(Workers, NeverMixTwoRounds) {
  Workers workers(4);
  for (int round = 0; round < 200000; ++round) {
    std::atomic<int> calls{0};
    const int count = 2 + round % 3 * 7;
    workers.run(count, [&](int i) {
      if (i < count)
        ++calls;
      else
        ADD_FAILURE() << "index " << i << " of " << count;
    });
    ASSERT_EQ(calls.load(), count) << "round " << round;
  }
}

TEST(Workers, MakeTheirWritesVisibleToTheCaller) {
  Workers workers(3);
  std::vector<double> values(500);
  for (int round = 0; round < 200; ++round) {
    workers.run(500, [&](int i) { values[static_cast<std::size_t>(i)] = round * i; });
    for (int i = 0; i < 500; ++i) ASSERT_EQ(values[static_cast<std::size_t>(i)], round * i);
  }
}

TEST(Workers, WhatIsThrownComesOutOnceAndTheNextRoundIsWhole) {
  for (const int threads : {1, 2, 4}) {
    Workers workers(threads);
    for (int round = 0; round < 100; ++round) {
      EXPECT_THROW(workers.run(20,
                               [&](int i) {
                                 if (i % 7 == round % 7) throw std::bad_alloc();
                               }),
                   std::bad_alloc);
      std::atomic<int> calls{0};
      workers.run(20, [&](int) { ++calls; });
      ASSERT_EQ(calls.load(), 20);
    }
  }
}

TEST(Workers, MoreIndicesThanOneRoundHolds) {
  Workers workers(3);
  constexpr int kCount = (1 << 21) + 5;
  std::vector<char> seen(kCount, 0);
  workers.run(kCount, [&](int i) { ++seen[static_cast<std::size_t>(i)]; });
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), kCount);
}

#ifndef SEINE_SANITIZED
// A process that may have no more memory, and so no stacks, works with the threads it gets.
TEST(Workers, ThreadsThatCannotBeHadAreDoneWithout) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{std::size_t{150} << 20, std::size_t{150} << 20};
    ::setrlimit(RLIMIT_AS, &limit);
    Workers workers(500);
    std::atomic<int> calls{0};
    workers.run(100, [&](int) { ++calls; });
    ::_exit(workers.count() < 500 && calls.load() == 100 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}
#endif

}  // namespace
}  // namespace seine
