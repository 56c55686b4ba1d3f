#include "seine/planner/attempts.hpp"

namespace seine::planner {

Attempt attempt(int rung) {
  const auto guess = static_cast<std::uint64_t>(rung / 4);
  // The finer pieces and the wider margins differ from guess to guess.
  constexpr double kFiner[] = {1.5, 2.2, 1.2}, kRoomier[] = {0.05, 0.02, 0.08};
  switch (rung % 4) {
    case 0:
      return {.guess = guess};
    case 1:
      return {.guess = guess, .gently = true};
    case 2:
      return {.guess = guess, .finer = kFiner[guess % 3]};
    default:
      return {.guess = guess, .finer = guess % 2 == 0 ? 1.0 : 1.5, .roomier = kRoomier[guess % 3]};
  }
}

}  // namespace seine::planner
