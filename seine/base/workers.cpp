#include "seine/base/workers.hpp"

#include <algorithm>
#include <cstdint>

namespace seine {
namespace {

constexpr int kIndexBits = 24;
constexpr std::uint64_t kIndexMask = (1ULL << kIndexBits) - 1;
// Rounds follow each other within microseconds while a problem is being solved; a thread that slept in
// between would cost more than the work. After this many idle spins (some 50 µs) it does sleep.
constexpr int kSpins = 20000;

void pause_briefly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Workers::Workers(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { loop(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void Workers::dispatch(int count, void* context, Call call) {
  const std::uint64_t round = round_.load() + 1;
  count_ = count;
  context_ = context;
  call_ = call;
  unfinished_ = count;
  next_ = round << kIndexBits;
  {
    const std::lock_guard lock(mutex_);  // pairs with the wait in loop(): no wake-up is lost
    round_ = round;
  }
  wake_.notify_all();
  take(round);
  while (unfinished_.load(std::memory_order_acquire) > 0) pause_briefly();
}

void Workers::take(std::uint64_t round) {
  for (;;) {
    std::uint64_t seen = next_.load();
    if ((seen >> kIndexBits) != round) return;
    const int index = static_cast<int>(seen & kIndexMask);
    if (index >= count_.load()) return;
    if (!next_.compare_exchange_weak(seen, seen + 1)) continue;
    call_.load()(context_.load(), index);
    unfinished_.fetch_sub(1, std::memory_order_acq_rel);
  }
}

void Workers::loop() {
  std::uint64_t done = 0;
  for (;;) {
    for (int spin = 0; spin < kSpins && round_.load() == done && !stop_.load(); ++spin) pause_briefly();
    if (round_.load() == done) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_.load() || round_.load() != done; });
    }
    if (stop_.load()) return;
    done = round_.load();
    take(done);
  }
}

}  // namespace seine
