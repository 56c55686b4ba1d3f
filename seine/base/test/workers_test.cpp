#include "seine/base/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
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

}  // namespace
}  // namespace seine
