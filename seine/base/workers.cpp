#include "seine/base/workers.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace seine {
namespace {

// A round in one word: its number, how many indices it has, and the next free one.
constexpr int kIndexBits = 20;
constexpr std::uint64_t kIndexMask = (1ULL << kIndexBits) - 1;
constexpr int kRoundShift = 2 * kIndexBits;
constexpr std::uint64_t kRoundMask = (1ULL << (64 - kRoundShift)) - 1;

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
  if (static_cast<std::uint64_t>(count) > kIndexMask)
    throw std::length_error("too many indices for one round");
  const std::uint64_t round = round_.load() + 1;
  context_ = context;
  call_ = call;
  unfinished_ = count;
  word_ = ((round & kRoundMask) << kRoundShift) | (static_cast<std::uint64_t>(count) << kIndexBits);
  {
    const std::lock_guard lock(mutex_);  // pairs with the wait in loop(): no wake-up is lost
    round_ = round;
  }
  wake_.notify_all();
  take(round);
  while (unfinished_.load(std::memory_order_acquire) > 0) pause_briefly();
}

// A successful exchange proves that the round was still this one and had an index left; until that index is
// done the round cannot end, so its function and context stay.
void Workers::take(std::uint64_t round) {
  for (;;) {
    std::uint64_t seen = word_.load();
    const std::uint64_t index = seen & kIndexMask, count = (seen >> kIndexBits) & kIndexMask;
    if ((seen >> kRoundShift) != (round & kRoundMask) || index >= count) return;
    if (!word_.compare_exchange_weak(seen, seen + 1)) continue;
    call_.load()(context_.load(), static_cast<int>(index));
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
