#pragma once

#include <vector>

#include "seine/constraint/registry.hpp"

namespace seine::constraint {

/// The part of the registry that a net brings.
std::vector<math::Formula> net_registry();

}  // namespace seine::constraint
