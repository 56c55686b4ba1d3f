#pragma once

#include <vector>

#include "seine/math/formula.hpp"

namespace seine::baseline::letter {

/// Every formula of this room that has a gradient, so that one test can check all of them. Net size, topology
/// and corridor use those of room `constraint`, whose own registry has them.
std::vector<math::Formula> registry();

}  // namespace seine::baseline::letter
