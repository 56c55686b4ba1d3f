#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seine/base/rng.hpp"

namespace seine::baseline::letter {

/// A term of the letter's as a plain function of numbers, so that one test can check the gradient of all.
struct Entry {
  std::string name;
  int inputs;
  std::function<double(std::span<const double> x, std::span<double> gradient)> value;
  std::function<void(Rng&, std::span<double> x)> draw;  ///< a random point
};

/// Every formula of this room that has a gradient. Net size, topology and corridor use those of room
/// `constraint`, whose own registry has them.
std::vector<Entry> registry();

}  // namespace seine::baseline::letter
