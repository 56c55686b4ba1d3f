#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace seine {

/// A few threads that run the same function over a range of indices, many thousand times a second. The
/// calling thread works too. Which thread takes which index is left open: callers write to places that depend
/// on the index only, so results never depend on the number of threads. What the function throws comes out of
/// run, one of them where there are several; which indices have had their turn by then is left open.
class Workers {
 public:
  /// @param threads how many work at once, the caller included; 0 means as many as the machine has. Where the
  /// system does not give as many, fewer do the work: count() says how many.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int count() const { return static_cast<int>(threads_.size()) + 1; }

  /// Calls f(0) … f(count − 1), each once, and returns when all are done.
  template <class F>
  void run(int count, F&& f) {
    if (threads_.empty() || count < 2) {
      for (int i = 0; i < count; ++i) f(i);
      return;
    }
    using Function = std::remove_reference_t<F>;
    dispatch(count, &f, [](void* context, int index) { (*static_cast<Function*>(context))(index); });
  }

 private:
  using Call = void (*)(void*, int);
  void dispatch(int count, void* context, Call call);
  void round(int first, int count, void* context, Call call);
  void take(std::uint64_t round);
  void stop();
  void loop();

  std::vector<std::thread> threads_;
  // The round's number, its count and its next free index share one word, so that a late thread can never
  // take an index of a round it has not seen begin, nor mix the count of one round with the index of another.
  std::atomic<std::uint64_t> word_{0};
  std::atomic<int> unfinished_{0};
  std::atomic<std::uint64_t> round_{0};
  std::atomic<bool> stop_{false};
  std::atomic<void*> context_{nullptr};
  std::atomic<Call> call_{nullptr};
  std::atomic<int> first_{0};  // of the indices of the round
  std::mutex failure_mutex_;
  std::exception_ptr failure_;  // what was thrown first in the round
  std::mutex mutex_;
  std::condition_variable wake_;
};

}  // namespace seine
