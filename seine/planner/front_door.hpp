#pragma once

#include <functional>

#include "seine/planner/planner.hpp"

namespace seine::planner {

/// Any method behind the common signature.
using Method = std::function<PlanResult(const world::Scenario&, const Options&)>;

/// What every method may rely on: start speeds within the limits (measured ones may be a little over, see
/// world::granted_speed) and coordinates near the origin (docs/scenario.md). A scenario that is not like that
/// is planned as one that is; the plan comes back in the scenario's own frame and is certified in it.
PlanResult by(const Method& method, const world::Scenario& scenario, const Options& options);

}  // namespace seine::planner
