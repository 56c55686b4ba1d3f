#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"

namespace seine::constraint {

/// A constraint as a plain function of numbers, so that one test can check the gradient of all.
struct Entry {
  std::string name;  ///< of the file that defines it
  int inputs;
  std::function<double(std::span<const double> x, std::span<double> gradient)> value;
  std::function<void(Rng&, std::span<double> x)> draw;  ///< a random point away from kinks
};

/// Every constraint of this room, one entry a file. A file that is missing here fails a test.
std::vector<Entry> registry();

}  // namespace seine::constraint
