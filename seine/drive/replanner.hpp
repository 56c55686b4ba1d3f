#pragma once

#include <cstdint>

#include "seine/sim/simulation.hpp"

namespace seine::drive {

struct ReplannerOptions {
  int threads = 1;  ///< the others are the cars'
  std::uint64_t seed = 0;
};

/// Plans on from what is left of the plan that the team follows, within the deadline it is given.
sim::Replanner replanner(const ReplannerOptions& options = {});

}  // namespace seine::drive
