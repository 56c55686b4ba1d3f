#include "seine/base/workers.hpp"

#include <algorithm>
#include <cstdint>
#include <system_error>
#include <utility>

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
  try {
    threads_.reserve(static_cast<std::size_t>(threads - 1));
    for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { loop(); });
  } catch (const std::system_error&) {  // no more threads to be had: those there are do the work
  } catch (...) {
    stop();
    throw;
  }
}

Workers::~Workers() {
  stop();
}

void Workers::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void Workers::dispatch(int count, void* context, Call call) {
  constexpr int kMost = static_cast<int>(kIndexMask);
  for (int first = 0; first < count; first += std::min(kMost, count - first))
    round(first, std::min(kMost, count - first), context, call);
}

void Workers::round(int first, int count, void* context, Call call) {
  const std::uint64_t round = round_.load() + 1;
  context_ = context;
  call_ = call;
  first_ = first;
  unfinished_ = count;
  word_ = ((round & kRoundMask) << kRoundShift) | (static_cast<std::uint64_t>(count) << kIndexBits);
  {
    const std::lock_guard lock(mutex_);  // pairs with the wait in loop(): no wake-up is lost
    round_ = round;
  }
  wake_.notify_all();
  take(round);
  while (unfinished_.load(std::memory_order_acquire) > 0) pause_briefly();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

// A successful exchange proves that the round was still this one and had an index left; until that index is
// done the round cannot end, so its function and context stay.
void Workers::take(std::uint64_t round) {
  for (;;) {
    std::uint64_t seen = word_.load();
    const std::uint64_t index = seen & kIndexMask, count = (seen >> kIndexBits) & kIndexMask;
    if ((seen >> kRoundShift) != (round & kRoundMask) || index >= count) return;
    if (!word_.compare_exchange_weak(seen, seen + 1)) continue;
    try {
      call_.load()(context_.load(), first_.load() + static_cast<int>(index));
    } catch (...) {
      const std::lock_guard lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
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
