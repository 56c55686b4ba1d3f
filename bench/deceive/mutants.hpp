#pragma once

#include <optional>

#include "bench/deceive/construction.hpp"
#include "seine/base/rng.hpp"

namespace seine::deceive {

/// A small change of a case, of the plan or of the question: rounding, a knot moved with its neighbours
/// fitted anew, other durations, joints that jump, standing segments put in between, tighter limits, moved
/// obstacles.
void mutate(Case& mutant, Rng& rng);

/// A task of any family, small enough to be planned in a fraction of a second.
world::Scenario random_task(Rng& rng);
/// A random task with its certified plan; absent where there is none within two seconds.
std::optional<Case> certified_case(Rng& rng);

}  // namespace seine::deceive
