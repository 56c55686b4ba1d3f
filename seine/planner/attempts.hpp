#pragma once

#include <cstdint>
#include <span>

namespace seine::planner {

/// One way to try a task: from which guess, and how it is optimised (docs/optimiser.md has the ladder).
struct Attempt {
  std::uint64_t guess =
      0;                 ///< which in the search's order: its seed, and room between cars that grows with it
  bool gently = false;   ///< stiff constraints at once: stays close to the guess
  double finer = 1.0;    ///< FitOptions::finer
  double roomier = 0.0;  ///< car lengths: margins the guess and the optimiser keep beyond those asked for
};

/// The ladder's rungs, from what is quick and good as a rule to what is rarely needed: a guess freely and
/// gently, in finer pieces, with more room, and then the next guess.
Attempt attempt(int rung);

/// How many rungs are tried without a deadline, so that the outcome is a matter of counts; and with one, as
/// long as it lasts.
inline constexpr int kRungs = 16, kMostRungs = 400;

}  // namespace seine::planner
