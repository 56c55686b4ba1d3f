#pragma once

#include <vector>

#include "seine/math/formula.hpp"

namespace seine::constraint {

/// Every constraint of this room, one entry a file and named after it, drawn away from kinks, so that one
/// test can check all gradients. A file that is missing here fails a test.
std::vector<math::Formula> registry();

}  // namespace seine::constraint
