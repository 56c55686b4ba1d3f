#pragma once

#include "seine/baseline/letter/settings.hpp"
#include "seine/planner/planner.hpp"

namespace seine::baseline::letter {

/// Plans as the letter does [Pei24] (docs/letter.md), in the signature of planner::plan. `claimed` is what
/// the method says of itself; `certified` is the certificate's verdict as for every plan. The plan is
/// meaningful when either holds. Throws InputError for scenarios that are wrong in themselves or ask what the
/// method does not know: moving obstacles, going on from an earlier plan, cars that stand.
planner::PlanResult plan(const world::Scenario& scenario, const planner::Options& options = {},
                         const Settings& settings = {});

}  // namespace seine::baseline::letter
