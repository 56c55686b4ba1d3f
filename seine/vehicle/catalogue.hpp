#pragma once

#include <span>
#include <string_view>

#include "seine/vehicle/model.hpp"

namespace seine::vehicle {

/// A real vehicle as a planner sees it, and where its figures come from.
struct CatalogueEntry {
  Model model;         ///< `model.name` is what it is asked for by
  const char* source;  ///< of its dimensions and limits; what is assumed stands in brackets
};

/// Vehicles people plan for, from 0.25 to 12 m, smallest first: for tests, examples and measurements.
///
/// A rear-steered vehicle (the forklift) has its body frame at the middle of the fixed front axle, x towards
/// the forks. Its footprint reaches far behind that axle. It follows the same curves as a car with steered
/// front wheels; only the wheel's angle has the other sign.
std::span<const CatalogueEntry> catalogue();

/// The model of that name, or null.
const Model* catalogued(std::string_view name);

}  // namespace seine::vehicle
